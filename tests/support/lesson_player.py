"""A student who does a lesson in a real browser, as its own solutions say."""

from __future__ import annotations

import numpy as np

from armlab.content.actions import Action, Move, TypeAnswer
from armlab.content.lesson import Lesson, Step
from armlab.content.question import Choices, Grid, Question
from support.page import LabPage

TEXT_OF = (
    "html => { const box = document.createElement('template'); box.innerHTML = html; return box.content.textContent; }"
)


class LessonPlayer:
    """Goes through an open lesson; only moves of joints and answers are known to it."""

    def __init__(self, lab: LabPage, lesson: Lesson) -> None:
        self.lab, self.page, self.lesson = lab, lab.page, lesson

    def at(self, step: int) -> None:
        """Wait until a step is shown, from 1."""
        label = self.page.locator(".lesson-text h2 small")
        self.lab.until(lambda: label.inner_text() == f"{step} of {len(self.lesson.steps)}")

    def click(self, cell: str) -> None:
        """Press a button of the lesson, without waiting for what comes of it."""
        self.page.locator(f'button[data-cell="{cell}"]').first.click()

    def hint(self) -> None:
        """Unlock the next hint."""
        count = self.page.locator(".lesson-text .hint").count()
        self.click("lesson-hint")
        self.lab.until(lambda: self.page.locator(".lesson-text .hint").count() == count + 1)

    def answer(self, question: Question, typed: str) -> None:
        """Answer by clicking and typing."""
        if isinstance(question.form, Choices):
            for option in typed.split(","):
                self.click(f"lesson-choice-{option}")
            if question.form.several:
                self.click("lesson-check")
        elif isinstance(question.form, Grid):
            for i, row in enumerate(typed.split(";")):
                for j, entry in enumerate(row.split()):
                    self.page.locator(f'input[data-cell="lesson-entry-{i}-{j}"]').fill(entry)
            self.click("lesson-check")
        else:
            field = self.page.locator('input[data-cell="lesson-answer"]')
            field.fill(typed)
            field.press("Enter")

    def says(self, kind: str, html: str) -> None:
        """Wait until a verdict says this."""
        text = self.page.evaluate(TEXT_OF, html)
        verdicts = self.page.locator(f".verdict.{kind}")
        self.lab.until(lambda: any(text in found for found in verdicts.all_text_contents()))

    def wrong(self, step: Step) -> None:
        """Give the first wrong answer that the lesson names, if it is not the one that counts."""
        question = step.question
        if question is not None and question.wrong and not question.hide:
            self.answer(question, question.wrong[0].typed)
            self.says("no", question.judge(question.wrong[0].typed).says)

    def solve(self, step: Step) -> None:
        """Do what the solution says, and answer; a prediction comes first, for the arm is hidden before."""
        question = step.question
        if question is not None and question.hide:
            self.answer(question, question.right_answer)
            self.says("ok", "Right.")
        for action in step.solution:
            self.act(action, question)
        if question is not None and not question.hide:
            self.answer(question, question.right_answer)
            self.says("ok", "Right.")
        self.lab.until(lambda: self.page.locator(".strip[aria-current].done").count() == 1)

    def act(self, action: Action, question: Question | None) -> None:
        """Do one action of a solution."""
        if isinstance(action, Move):
            self.lab.open_tab("Joints")
            for i, value in enumerate(action.q):
                revolute = self.lesson.robot_used.arm.rows[i].revolute
                self.set_joint(i + 1, float(np.degrees(value) if revolute else 1000.0 * value))
        elif isinstance(action, TypeAnswer) and question is not None:
            self.answer(question, action.text)
        else:
            raise NotImplementedError(f"{action} is not done by hand here")

    def set_joint(self, joint: int, value: float) -> None:
        """Type a joint value into the field beside its slider: degrees or millimetres."""
        self.lab.type_into(f"value {joint}", f"{value:.1f}")
        self.lab.until(lambda: abs(self.lab.slider_value(joint) - value) < 0.06)
