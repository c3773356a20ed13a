"""A lesson whose starts, solutions and checks are in words of benches."""

BENCHES = """+++
title = "Benches"
chapter = "5"
teaches = ["S5.4-statics"]
robot = "planar_2r"
q_deg = [30, 60]
panel = "statics"
locked = ["joints", "target"]

[variants]
most = { choose = [5, 4, 3] }

[[do]]
command = "velocity.statics.set_component"
kind = "force"
axis = 0
value = 0

[[do]]
command = "velocity.statics.set_component"
kind = "force"
axis = 1
value = "= 4*most"
+++
The torques are {{velocity.statics.torques}}.

## Less torque

```check
kind = "fact"
fact = "velocity.statics.largest_torque"
at_most = "= most"
```

```solution
[[do]]
command = "velocity.statics.set_component"
kind = "force"
axis = 1
value = 2
```

## Turn

The tool turns with {{velocity.speeds.turning_speed}}.

```start
panel = "velocity"

[[do]]
kind = "move"
q_deg = [0, 90]

[[do]]
command = "velocity.speeds.set_speed"
joint = 0
value = 0

[[do]]
command = "velocity.speeds.set_speed"
joint = 1
value_deg = 30
```

```check
kind = "all_of"

[[checks]]
kind = "fact"
fact = "velocity.speeds.angular_velocity"
value_deg = [0, 0, 90]
tolerance_deg = 1

[[checks]]
kind = "joint_at"
joint = 2
value_deg = 90
tolerance_deg = 1

[[wrong]]
kind = "fact"
fact = "velocity.speeds.angular_velocity"
component = 3
value_deg = -90
tolerance_deg = 1
says = "The other way round."
```

```solution
[[do]]
command = "velocity.speeds.set_speed"
joint = 0
value_deg = 60
```

## Iterate

```start
panel = "iterations"
```

```check
kind = "fact"
fact = "iterate.runs.status"
value = "most"
```

```solution
[[do]]
command = "iterate.runs.set"
most = 2
```
"""
