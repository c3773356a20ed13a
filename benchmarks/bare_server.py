"""The judge of our latency: the least one can do with viser alone. One thread, latest event wins, 1 ms of "solving".

Six nested frames with a cylinder each, a handle, and a sphere that is sent to where the handle was. No panels, no
sessions, no front. Prints its port.
"""

import contextlib
import socket
import sys
import threading
import time
from typing import Any

import numpy as np
import viser

SOLVING = 1e-3


class Student:
    def __init__(self, client: viser.ClientHandle, wake: threading.Event, waiting: dict["Student", None]) -> None:
        self.client, self.joints = client, []
        with client.atomic():
            path = "/arm"
            client.scene.add_frame(path, show_axes=False)
            for i in range(6):
                path += f"/{i}"
                self.joints.append(client.scene.add_frame(path, show_axes=False, position=(0, 0, 0.25)))
                client.scene.add_cylinder(path + "/body", radius=0.05, height=0.25, color=(230, 120, 40))
            self.echo = client.scene.add_icosphere("/echo", radius=0.03)
            self.handle = client.scene.add_transform_controls(
                "/target", scale=0.4, depth_test=False, position=(0.6, 0.0, 0.9)
            )

        @self.handle.on_update
        async def _(_event: Any) -> None:
            waiting[self] = None
            wake.set()

    def write(self, point: np.ndarray, angles: np.ndarray) -> None:
        with self.client.atomic():
            for joint, angle in zip(self.joints, angles, strict=True):
                joint.wxyz = (np.cos(angle / 2), 0.0, np.sin(angle / 2), 0.0)
            self.echo.position = tuple(map(float, point))
        self.client.flush()


def solved(point: np.ndarray) -> np.ndarray:
    until = time.perf_counter() + SOLVING
    while time.perf_counter() < until:
        pass
    return np.outer(point, (1.0, 0.5)).ravel()


def main() -> None:
    with socket.create_server(("127.0.0.1", 0)) as free:
        port = free.getsockname()[1]
    with contextlib.redirect_stdout(sys.stderr):  # its banner
        server = viser.ViserServer("127.0.0.1", port, verbose=False)
    wake, waiting = threading.Event(), {}
    students: list[Student] = []
    server.on_client_connect(lambda client: students.append(Student(client, wake, waiting)))
    print(server.get_port(), flush=True)
    loop = server.get_event_loop()
    while True:
        wake.wait()
        wake.clear()
        while waiting:
            student = next(iter(waiting))
            del waiting[student]
            point = student.handle.position
            loop.call_soon_threadsafe(student.write, point, solved(point))


if __name__ == "__main__":
    main()
