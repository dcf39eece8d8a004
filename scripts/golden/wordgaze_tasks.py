"""Wordgaze's one-room tasks, written for the reference: Wordgaze-{One,Two}-N{N}-K{K}[-auto]-v0.

A square room of N cells a side, walls included, with K objects, no two alike. One or two of them are
targets: the agent is to go to a target or to pick it up; two targets are joined by "and", ", then" or
"after you". Without -auto each sub-task is declared by its own done action, in its order ("sequential");
with -auto the reference's verifier decides and done means nothing.
"""
import re

import gymnasium as gym
from minigrid.core.actions import Actions
from minigrid.envs.babyai.core import verifier
from minigrid.envs.babyai.core.roomgrid_level import RejectSampling, RoomGridLevel

PATTERN = re.compile(r"Wordgaze-(One|Two)-N(\d+)-K(\d+)(-auto)?-v0")
JOINS = {"and": verifier.AndInstr, "before": verifier.BeforeInstr, "after": verifier.AfterInstr}
VERBS = {"goto": verifier.GoToInstr, "pickup": verifier.PickupInstr}


class OneRoomTask(RoomGridLevel):
    """The room and its instruction; the reference's own verifier."""

    def __init__(self, size, objects, targets, **kwargs):
        self.objects, self.targets = objects, targets
        super().__init__(room_size=size, num_rows=1, num_cols=1, **kwargs)

    def sub_task(self, target):
        verb = VERBS[self._rand_elem(list(VERBS))]
        return verb(verifier.ObjDesc(target.type, target.color))

    def gen_mission(self):
        # The order of the draws is part of the definition.
        self.place_agent()
        objects = self.add_distractors(num_distractors=self.objects, all_unique=True)
        self.check_objs_reachable()
        targets = self._rand_subset(objects, self.targets)
        if len({(o.type, o.color) for o in targets}) < len(targets):
            raise RejectSampling("two targets of one kind")
        parts = [self.sub_task(target) for target in targets]
        if self.targets == 1:
            (self.instrs,) = parts
        else:
            self.instrs = JOINS[self._rand_elem(list(JOINS))](*parts)

    def sub_tasks(self):
        """In the order of the sentence."""
        if self.targets == 1:
            return [self.instrs]
        return [self.instrs.instr_a, self.instrs.instr_b]

    @property
    def completion(self):
        if self.targets == 1:
            return [int(self.succeeded)]
        return [int(done == "success") for done in (self.instrs.a_done, self.instrs.b_done)]

    def reset(self, **kwargs):
        self.succeeded = False
        return super().reset(**kwargs)

    def step(self, action):
        result = super().step(action)
        self.succeeded = result[2] and result[1] > 0
        return result


class DeclaredOneRoomTask(OneRoomTask):
    """The same, each sub-task declared by the done action."""

    def reset(self, **kwargs):
        result = super().reset(**kwargs)
        self.declared = [False] * self.targets
        self.true_now = [False] * self.targets
        return result

    @property
    def completion(self):
        return [int(done) for done in self.declared]

    def declarable(self):
        waiting = [k for k in range(self.targets) if not self.declared[k]]
        if isinstance(self.instrs, verifier.BeforeInstr):
            return waiting[:1]
        if isinstance(self.instrs, verifier.AfterInstr):
            return waiting[-1:]
        return waiting

    def declare(self):
        """The verdict on a done action: success, failure, or None to go on."""
        hits = [k for k in self.declarable() if self.true_now[k]]
        for k in hits:
            self.declared[k] = True
        for k in self.declarable():  # it must come true again
            self.true_now[k] = False
        if not hits:
            return "failure"
        return "success" if all(self.declared) else None

    def step(self, action):
        # Past the step of RoomGridLevel, whose verifier is not asked.
        observation, reward, terminated, truncated, info = super(RoomGridLevel, self).step(action)
        if action == Actions.drop:
            self.update_objs_poss()
        verdict = None
        if action == Actions.done:
            verdict = self.declare()
        else:
            for k in self.declarable():
                self.true_now[k] = self.sub_tasks()[k].verify_action(action) == "success"
        if verdict is not None:
            terminated, reward = True, self._reward() if verdict == "success" else 0
        return observation, reward, terminated, truncated, info


def make(env_id):
    """The task of an id, or None."""
    match = PATTERN.fullmatch(env_id)
    if match is None:
        return None
    count, size, objects, auto = match.groups()
    task = OneRoomTask if auto else DeclaredOneRoomTask
    if env_id not in gym.registry:
        gym.register(env_id, entry_point=task, kwargs={
            "size": int(size), "objects": int(objects), "targets": 1 if count == "One" else 2})
    return gym.make(env_id, disable_env_checker=True)
