#!/usr/bin/env python3
"""The steps of an LCM log as a table for pandas, one row a step, and as CSV:

  mkdir -p types && lcm-gen --python --ppath types lcmtypes/*.lcm
  pip install lcm pandas && PYTHONPATH=types examples/log_to_table.py eval.lcmlog steps.csv
"""
import sys

import lcm
import pandas
from wordgaze import episode_begin_t, step_t


def steps(path):
    missions = {}
    for event in lcm.EventLog(path, "r"):
        if event.channel == "WORDGAZE_EPISODE_BEGIN":
            begin = episode_begin_t.decode(event.data)
            missions[begin.episode_id] = begin
        elif event.channel == "WORDGAZE_STEP":
            step = step_t.decode(event.data)
            begin = missions.get(step.episode_id)
            row = {"episode": step.episode_id, "run": begin and begin.run_id, "mission": begin and begin.mission}
            row |= {name: getattr(step, name) for name in ("step", "action", "value", "entropy", "reward", "terminated")}
            brightest = max(range(49), key=step.attention_map.__getitem__)
            row |= {"gaze_x": brightest // 7, "gaze_y": brightest % 7, "gaze": step.attention_map[brightest],
                    "nowhere": 1 - sum(step.attention_map)}
            row |= {f"weight_{i}": w for i, w in enumerate(step.word_weights)}
            yield row


table = pandas.DataFrame(steps(sys.argv[1]))
print(table.groupby(["run", "mission"])[["value", "gaze", "nowhere"]].mean().round(3).head(10))
if len(sys.argv) > 2:
    table.to_csv(sys.argv[2], index=False)
    print(f"{len(table)} steps in {sys.argv[2]}")
