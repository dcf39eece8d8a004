#!/usr/bin/env python3
"""An LCM log for the viewer of rerun: the gaze and the map of each word as pictures, weights and value as curves.

  mkdir -p types && lcm-gen --python --ppath types lcmtypes/*.lcm
  pip install lcm numpy rerun-sdk && PYTHONPATH=types examples/log_to_rerun.py eval.lcmlog eval.rrd && rerun eval.rrd
"""
import sys

import lcm
import numpy
import rerun
from wordgaze import episode_begin_t, step_t


def picture(numbers):
    """49 shares, as the agent looks: ahead is up."""
    return rerun.DepthImage(numpy.array(numbers, numpy.float32).reshape(7, 7).T, meter=1.0)


rerun.init("wordgaze", spawn=False)
rerun.save(sys.argv[2])
words, count = {}, 0
for event in lcm.EventLog(sys.argv[1], "r"):
    if event.channel == "WORDGAZE_EPISODE_BEGIN":
        begin = episode_begin_t.decode(event.data)
        words[begin.episode_id] = begin.tokens
    elif event.channel == "WORDGAZE_STEP":
        step = step_t.decode(event.data)
        path = f"episode_{step.episode_id}"
        rerun.set_time("step", sequence=step.step)
        rerun.log(f"{path}/gaze", picture(step.attention_map))
        rerun.log(f"{path}/value", rerun.Scalars(step.value))
        for i, word in enumerate(words.get(step.episode_id, [])[:step.num_tokens]):
            rerun.log(f"{path}/words/{i}_{word}/map", picture(step.word_attention[i]))
            rerun.log(f"{path}/words/{i}_{word}/weight", rerun.Scalars(step.word_weights[i]))
        count += 1
print(f"{count} steps in {sys.argv[2]}")
