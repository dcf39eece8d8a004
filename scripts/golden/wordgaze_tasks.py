"""Wordgaze's one-room tasks, written for the reference: Wordgaze-{One,...,Eight}-N{N}-K{K}[-auto]-v0.

A square room of N cells a side, walls included, with K objects, no two alike. One to eight of them
are targets: the agent is to go to a target or to pick it up. Two targets are joined by "and", ", then" or
"after you"; of three and four, some are joined by "and" and the two parts are put in an order; more are a
chain of such parts. Without -auto each
sub-task is declared by its own done action, in its order ("sequential"); with -auto the reference's
verifier decides and done means nothing. docs/simulator.md tells both.
"""
import re

import gymnasium as gym
from minigrid.core.actions import Actions
from minigrid.envs.babyai.core import verifier
from minigrid.envs.babyai.core.roomgrid_level import RejectSampling, RoomGridLevel

PATTERN = re.compile(r"Wordgaze-(One|Two|Three|Four|Five|Six|Seven|Eight)-N(\d+)-K(\d+)(-auto)?-v0")
NUMBERS = ("One", "Two", "Three", "Four", "Five", "Six", "Seven", "Eight")
And, Before, After = verifier.AndInstr, verifier.BeforeInstr, verifier.AfterInstr
VERBS = {"goto": verifier.GoToInstr, "pickup": verifier.PickupInstr}


def leaves(instruction):
    """The sub-tasks of an instruction, in the order of the sentence."""
    if not hasattr(instruction, "instr_a"):
        return [instruction]
    return leaves(instruction.instr_a) + leaves(instruction.instr_b)


def nested(kind, a, b):
    """An order of parts that are ordered themselves, which the reference verifies but does not construct."""
    instruction = kind.__new__(kind)
    verifier.Instr.__init__(instruction)
    instruction.instr_a, instruction.instr_b, instruction.strict = a, b, False
    return instruction


def sequence(parts):
    """The parts one after the other."""
    return parts[0] if len(parts) == 1 else nested(Before, parts[0], sequence(parts[1:]))


def turns(instruction):
    """Its parts in the order in which they are to be done."""
    if isinstance(instruction, Before):
        return turns(instruction.instr_a) + turns(instruction.instr_b)
    if isinstance(instruction, After):
        return turns(instruction.instr_b) + turns(instruction.instr_a)
    return [instruction]


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
        self.instrs = self.joined([self.sub_task(target) for target in targets])

    def joined(self, parts):
        if len(parts) == 1:
            return parts[0]
        if len(parts) == 2:
            return self._rand_elem([And, Before, After])(*parts)
        if len(parts) > 4:
            return self.chain(parts)
        order = self._rand_elem([Before, After])
        if len(parts) == 4:
            return order(And(*parts[:2]), And(*parts[2:]))
        a, b, c = parts
        return order(And(a, b), c) if self._rand_elem([True, False]) else order(a, And(b, c))

    def chain(self, left):
        parts = []
        while left:
            size = 1 + self._rand_int(0, 2) if len(left) > 1 else 1
            parts.append(And(*left[:2]) if size == 2 else left[0])
            left = left[size:]
        if self._rand_elem([True, False]):
            return sequence(parts)
        after = 1 + self._rand_int(0, len(parts) - 1)
        return nested(After, sequence(parts[:after]), sequence(parts[after:]))

    def completion_of(self, instruction, done):
        """One 0/1 for each sub-task of an instruction; an instruction is done as a whole."""
        if not hasattr(instruction, "instr_a"):
            return [int(done)]
        return (self.completion_of(instruction.instr_a, done or instruction.a_done == "success")
                + self.completion_of(instruction.instr_b, done or instruction.b_done == "success"))

    @property
    def completion(self):
        return self.completion_of(self.instrs, self.succeeded)

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
        """Those of the part whose turn it is: the next one waits until it is all declared."""
        clauses = leaves(self.instrs)
        for part in turns(self.instrs):
            waiting = [k for k, clause in enumerate(clauses)
                       if clause in leaves(part) and not self.declared[k]]
            if waiting:
                return waiting
        return []

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
                self.true_now[k] = leaves(self.instrs)[k].verify_action(action) == "success"
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
            "size": int(size), "objects": int(objects), "targets": 1 + NUMBERS.index(count)})
    return gym.make(env_id, disable_env_checker=True)
