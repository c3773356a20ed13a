"""A lesson that uses everything the format has."""

RICH = """+++
title = "Two links of {{=l1}} m and {{=l2}} m"
chapter = "2 Direct kinematics"
teaches = ["S4.0-2R", "S4.1-dh"]
q_deg = ["= start", 20]
panel = "joints"
overlays = ["frames"]
locked = ["robot", "table"]
locked_joints = [2]
hidden = ["ellipsoid", "trainer"]

[target]
position = ["= l1 + l2", 0, 0]
rpy_deg = [0, 0, 90]

[camera]
azimuth_deg = -90
elevation_deg = 60
distance = 1.2

[variants]
l1 = { from = 0.4, to = 0.9, step = 0.1 }
l2 = { choose = [0.5, 1.0] }
side = { choose = ["left", "right"] }
start = { choose = [-30, 30] }
reach = "l1 + l2"

[arm]
name = "A {{=side}} arm"
convention = "standard"
task = "xy"

[[arm.joints]]
type = "R"
a = "= l1"
limits_deg = [-180, 180]

[[arm.joints]]
type = "R"
a = "= l2"
limits_deg = [-180, 180]
+++
The hand is at {{px}}, the determinant is {{ det J }}; it reaches {{=reach : .2f}} m to the {{=side}}.

## Stretch it

Turn joint 2 to zero: $p_x = {{=l1}} + {{=l2}}$, with $q_2 = {{-60}\\text{°}}$ before.
Now $q_2$ is {{q2}}.

```check
kind = "tool_at"
position = ["= reach", 0, 0]
tolerance_m = 0.01

[[wrong]]
says = "This is {{=l1 - l2}} m away: the arm is folded."
kind = "tool_at"
position = ["= l1 - l2", 0, 0]
tolerance_m = 0.01
q_deg = [0, 180]
```

```hint
Joint 1 is at {{q1}}.
```

```hint
Set $q_1 = 0$.
```

```reveal
It reaches {{=reach}} m.
```

```solution
q_deg = [0, 0]
```

## Compute

```python
reach = {{=-l1}}
```

```question
kind = "number"
text = "How far does it reach to the {{=side}}? It is {{r}} away."
answer = "= reach"
unit = "m"
tolerance = 0.001

[[wrong]]
answer = "= l1"
says = "This is the first link alone, {{=l1 : .1f}} m."
```

```solution
[[do]]
kind = "move"
q_deg = [10, 20]

[[do]]
kind = "target"
position = [0.5, 0.2, 0]
rpy_deg = [0, 0, 90]

[[do]]
kind = "cell"
row = 2
field = "theta_deg"
value = 90

[[do]]
kind = "switch"
name = "frames"
on = false

[[do]]
kind = "film"

[[do]]
kind = "wait"
seconds = 1.5

[[do]]
kind = "answer"
text = "= reach"
```
"""
