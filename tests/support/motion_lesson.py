"""A lesson about motions that uses what the format has for them."""

MOTION = """+++
title = "Corners"
chapter = "6 Motion"
teaches = ["S6.0-planning"]
robot = "puma560"
panel = "motion"
example = "motion/corner_stop"
+++
A square.

## Read

Corners.

## Fly over

It takes {{duration}}.

```check
kind = "all_of"

[[checks]]
kind = "move_is"
path = "overfly"

[[checks]]
kind = "motion_runs"
at_most_s = 7

[[checks]]
kind = "motion_played"

[[wrong]]
kind = "move_is"
space = "joint"
says = "These are *joint* moves."
```

```solution
[[do]]
kind = "move_kind"
path = "overfly"

[[do]]
kind = "motion"
```

## Slowly

```check
kind = "motion_runs"
at_least_s = 10
at_most_s = 10
velocity_percent = 60
```

```solution
[[do]]
kind = "duration"
seconds = 10
```

## Laws

```start
example = "laws/triangle"
panel = "laws"
```

```check
kind = "looked_at"
film = "laws"
```

```solution
[[do]]
kind = "film"
name = "laws"
```

## Waypoints

```start
example = "motion/spline"
panel = "motion"
```

```check
kind = "all_of"

[[checks]]
kind = "motion_runs"
waypoints = 6

[[checks]]
kind = "move_is"
to = 3
law = "quintic"
space = "cartesian"
```

```solution
[[do]]
kind = "move"
q_deg = [0, 60, -150, 0, -60, 0]

[[do]]
kind = "waypoint"

[[do]]
kind = "waypoint"
set = 1

[[do]]
kind = "waypoint"
after = 6

[[do]]
kind = "waypoint"
remove = 6

[[do]]
kind = "example"
name = "motion/corner_stop"

[[do]]
kind = "move"
q_deg = [0, 60, -150, 0, -60, 0]

[[do]]
kind = "waypoint"
after = 1

[[do]]
kind = "move_kind"
to = 3
law = "quintic"

[[do]]
kind = "limits"
velocity_percent = 80
acceleration_percent = 70
tool_speed_m_s = 0.4
jerk_time_s = 0.1
```
"""
