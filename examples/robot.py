#!/usr/bin/env python3
"""A robot that asks `wordgaze serve` what to do, with PyPI's lcm and the message types alone:

  mkdir -p types && lcm-gen --python --ppath types lcmtypes/policy_*.lcm
  pip install lcm && PYTHONPATH=types examples/robot.py [URL [MISSION]]
"""
import sys
import time

import lcm
from wordgaze import policy_reply_t, policy_request_t


class Client:
    def __init__(self, url, mission):
        self.bus, self.reply = lcm.LCM(url), None
        self.bus.subscribe("WORDGAZE_POLICY_REPLY", self.hear)
        self.request = policy_request_t()
        self.request.client_id, self.request.mission = time.time_ns(), mission
        self.request.direction = -1  # no compass

    def hear(self, channel, data):
        reply = policy_reply_t.decode(data)
        if (reply.client_id, reply.seq) == (self.request.client_id, self.request.seq):
            self.reply = reply

    def ask(self, image, reset):
        """Asks under the next number, and again under the same one where nothing comes back."""
        self.request.image, self.request.reset, self.reply = image, reset, None
        self.request.seq += 1
        for _ in range(10):
            self.bus.publish("WORDGAZE_POLICY_REQUEST", self.request.encode())
            while self.reply is None and self.bus.handle_timeout(200):
                pass
            if self.reply is not None:
                return self.reply
        sys.exit("nobody answers")


def view(right, ahead):
    """A world to try it in: a floor, and a red ball so many cells to the right and ahead."""
    ball = (3 + right, 6 - ahead)
    return bytes(b for x in range(7) for y in range(7) for b in (6 if (x, y) == ball else 1, 0, 0))


usual = ["udpm://239.255.76.67:7667?ttl=0", "go to the red ball"]
client = Client(*sys.argv[1:], *usual[len(sys.argv) - 1:])
right, ahead = -2, 3
for step in range(30):
    reply = client.ask(view(right, ahead), reset=step == 0)
    if reply.error:
        sys.exit(reply.error)
    names = ["left", "right", "forward", "pickup", "drop", "toggle", "done"]
    print(f"ball {right} right, {ahead} ahead: {names[reply.action]}")
    if reply.action == 0:
        right, ahead = ahead, -right  # the world turns the other way
    elif reply.action == 1:
        right, ahead = -ahead, right
    elif reply.action == 2 and (right, ahead) != (0, 1):
        ahead -= 1  # else the ball stands in the way
    elif reply.action == 6:
        sys.exit(0 if (right, ahead) == (0, 1) else 1)
sys.exit(1)
