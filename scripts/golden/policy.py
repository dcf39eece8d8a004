"""Who acts while traces are recorded. The actions are in the trace: replaying needs none of this."""
import contextlib
import io

from minigrid.core.actions import Actions

MASK = 2**64 - 1
GOLDEN = 0x9E3779B97F4A7C15
BOT_LOOKS = 400  # at its stack in one call; some plans of the reference's bot never end


def instructions(instruction):
    """The leaves of an instruction."""
    if hasattr(instruction, "instr_a"):
        return instructions(instruction.instr_a) + instructions(instruction.instr_b)
    return [] if instruction is None else [instruction]


def something_to_declare(env):
    if hasattr(env, "true_now"):
        return any(env.true_now[k] for k in env.declarable())
    return any(getattr(leaf, "lastStepMatch", False)
               for leaf in instructions(getattr(env, "instrs", None)))


class RandomPolicy:
    """The library's RandomPolicy, draw by draw: it walks on, opens doors, picks things up, and with
    `declares` says done now and then, more often when there is something to declare."""

    def __init__(self, env_id, seed, policy_seed, declares):
        state = 0xCBF29CE484222325
        for byte in env_id.encode():
            state = (state ^ byte) * 0x100000001B3 & MASK
        self.state = state ^ (seed * GOLDEN & MASK) ^ policy_seed
        self.declares = declares

    def below(self, n):
        self.state = (self.state + GOLDEN) & MASK
        z = self.state
        z = (z ^ z >> 30) * 0xBF58476D1CE4E5B9 & MASK
        z = (z ^ z >> 27) * 0x94D049BB133111EB & MASK
        return (z ^ z >> 31) % int(n)

    def percent(self):
        return self.below(100)

    def turn(self):
        return Actions.left if self.below(2) == 0 else Actions.right

    def one_of(self, *chances):
        """(limit, action)...: the first whose limit is above a drawn percentage, else a turn."""
        q = self.percent()
        for limit, action in chances:
            if q < limit:
                return action
        return self.turn()

    def choose(self, env):
        cell = env.grid.get(*(int(v) for v in env.front_pos))
        ahead = "empty" if cell is None else cell.type
        carrying = env.carrying is not None
        if self.percent() < 12:
            return self.below(env.action_space.n)
        if self.declares:
            if self.percent() < 6:
                return Actions.done
            if something_to_declare(env) and self.percent() < 50:
                return Actions.done
        if ahead in ("key", "ball", "box"):
            if carrying:
                return self.one_of((10, Actions.toggle), (15, Actions.drop))
            return self.one_of((55, Actions.pickup), (63, Actions.toggle))
        if ahead == "door":
            return self.one_of((45, Actions.toggle), (85, Actions.forward))
        if ahead in ("empty", "floor") and carrying:
            return self.one_of((20, Actions.drop), (75, Actions.forward))
        if ahead in ("empty", "floor", "goal"):
            return self.one_of((75, Actions.forward))
        if ahead == "lava":
            return self.one_of((8, Actions.forward))
        return self.turn()

    def reset(self, env):
        pass

    def __call__(self, env):
        action = int(self.choose(env))
        return action if action < env.action_space.n else self.below(env.action_space.n)


class BoundedStack(list):
    looks = 0

    def __getitem__(self, index):
        self.looks += 1
        if self.looks > BOT_LOOKS:
            raise RuntimeError("the plan does not end")
        return super().__getitem__(index)


class BotPolicy:
    """The reference's rule-based expert while it knows what to do, then the random policy."""

    def __init__(self, fallback):
        self.fallback = fallback
        self.bot = None

    def reset(self, env):
        from minigrid.utils.baby_ai_bot import BabyAIBot
        self.bot, self.last = None, None
        if getattr(env, "instrs", None) is None:
            return
        try:
            with contextlib.redirect_stdout(io.StringIO()):
                self.bot = BabyAIBot(env)
            self.bot.stack = BoundedStack(self.bot.stack)
        except Exception:  # whatever keeps the bot from planning, the random policy takes over
            self.bot = None

    def __call__(self, env):
        if self.bot is not None:
            if self.fallback.declares and something_to_declare(env) and self.fallback.percent() < 85:
                self.last = Actions.done
                return int(Actions.done)
            try:
                self.bot.stack.looks = 0
                with contextlib.redirect_stdout(io.StringIO()):
                    action = Actions(self.bot.replan(self.last))
                if action != Actions.done:
                    self.last = action
                    return int(action)
            except Exception:
                pass
            self.bot = None
        return self.fallback(env)


def make(kind, env_id, seed, policy_seed, declares):
    policy = RandomPolicy(env_id, seed, policy_seed, declares)
    if kind == "bot" or (kind == "mixed" and seed % 2 == 0):
        return BotPolicy(policy)
    return policy
