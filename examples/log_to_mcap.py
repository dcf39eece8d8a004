#!/usr/bin/env python3
"""An LCM log as MCAP, which Foxglove and PlotJuggler open: each message as JSON on a topic of its own.

  mkdir -p types && lcm-gen --python --ppath types lcmtypes/*.lcm
  pip install lcm mcap && PYTHONPATH=types examples/log_to_mcap.py eval.lcmlog eval.mcap
"""
import json
import sys

import lcm
import wordgaze
from mcap.writer import Writer

TYPES = {"EPISODE_BEGIN": wordgaze.episode_begin_t, "WORLD": wordgaze.world_t, "PROGRESS": wordgaze.progress_t,
         "STEP": wordgaze.step_t, "EPISODE_END": wordgaze.episode_end_t, "METRICS": wordgaze.metrics_t}


def plain(value):
    return value if isinstance(value, (int, float, str)) else [plain(entry) for entry in value]


with open(sys.argv[2], "wb") as file:
    writer = Writer(file)
    writer.start()
    topics, count = {}, 0
    for event in lcm.EventLog(sys.argv[1], "r"):
        name = event.channel.removeprefix("WORDGAZE_")
        if name not in TYPES:
            continue
        message = TYPES[name].decode(event.data)
        fields = {field: plain(getattr(message, field)) for field in message.__slots__}
        if name == "METRICS":  # a field a number, to be plotted
            fields = dict(zip(message.name, message.value), update=message.update, frames=message.frames)
        if name not in topics:
            schema = writer.register_schema(f"wordgaze.{name.lower()}", "jsonschema", b'{"type": "object"}')
            topics[name] = writer.register_channel(f"/wordgaze/{name.lower()}", "json", schema)
        time = event.timestamp * 1000  # nanoseconds
        writer.add_message(topics[name], log_time=time, publish_time=time, data=json.dumps(fields).encode())
        count += 1
    writer.finish()
print(f"{count} messages on {len(topics)} topics in {sys.argv[2]}")
