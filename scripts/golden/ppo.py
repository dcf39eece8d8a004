#!/usr/bin/env python3
"""Prints test/data/training/ppo.json for test/training/reference_test.cpp: advantages, losses and their gradients.

Advantages are sums over the future as their definition has them, not a recursion; the losses are
written with torch.distributions and differentiated by PyTorch; the optimizer is PyTorch's Adam. Needs
Debian's python3-torch.
"""
import json
import random
import sys

import torch
import torch.nn.functional as F

SEED = 20260103
ACTIONS = 7


def sixteenths(choice, low, high):
    """Numbers that float holds exactly."""
    return choice.randint(16 * low, 16 * high) / 16


def lane_advantages(reward, value, ended, next_value, discount, decay):
    """Of one lane; an episode's end cuts the sum over what is to come, be it terminated or truncated."""
    steps, following = len(reward), value[1:] + [next_value]
    surprise = [reward[t] + (0 if ended[t] else discount * following[t]) - value[t]
                for t in range(steps)]
    end = [next((k for k in range(t, steps) if ended[k]), steps - 1) for t in range(steps)]
    return [sum((discount * decay) ** (k - t) * surprise[k] for k in range(t, end[t] + 1))
            for t in range(steps)]


def objective(policy, value, action, old_log_prob, advantage, target, clip):
    """The parts of the loss, means over frames."""
    log_ratio = policy.log_prob(action) - old_log_prob
    ratio = log_ratio.exp()
    return {"policy": -torch.min(ratio * advantage,
                                 ratio.clamp(1 - clip, 1 + clip) * advantage).mean(),
            "value": F.mse_loss(value, target), "entropy": policy.entropy().mean(),
            "divergence": (ratio - 1 - log_ratio).mean(),
            "clipped": ((ratio - 1).abs() > clip).double().mean()}


def advantages(choice):
    """[lane][step]"""
    steps, lanes, discount, decay = 12, 3, 0.9375, 0.875
    reward, value = ([[sixteenths(choice, -2, 2) for _ in range(steps)] for _ in range(lanes)]
                     for _ in range(2))
    ended = [[int(choice.random() < 0.2) for _ in range(steps)] for _ in range(lanes)]
    next_value = [sixteenths(choice, -2, 2) for _ in range(lanes)]
    result = [lane_advantages(*lane, discount, decay) for lane in zip(reward, value, ended, next_value)]
    return {"discount": discount, "lambda": decay, "reward": reward, "value": value, "ended": ended,
            "next_value": next_value, "advantage": result}


def ppo_loss(choice):
    frames, clip, value_coefficient, entropy_coefficient = 40, 0.2, 0.5, 0.02
    logits = torch.tensor([[choice.gauss(0, 1.5) for _ in range(ACTIONS)] for _ in range(frames)],
                          requires_grad=True)
    value = torch.tensor([choice.gauss(0, 1) for _ in range(frames)], requires_grad=True)
    action = torch.tensor([choice.randrange(ACTIONS) for _ in range(frames)])
    policy = torch.distributions.Categorical(logits=logits)
    # Ratios on both sides of the clip.
    old_log_prob = policy.log_prob(action).detach() + torch.tensor(
        [choice.gauss(0, 0.3) for _ in range(frames)])
    advantage = torch.tensor([choice.gauss(0, 1) for _ in range(frames)])
    target = torch.tensor([choice.gauss(0, 1) for _ in range(frames)])
    parts = objective(policy, value, action, old_log_prob, advantage, target, clip)
    loss = (parts["policy"] + value_coefficient * parts["value"]
            - entropy_coefficient * parts["entropy"])
    loss.backward()
    return {"clip": clip, "value_coefficient": value_coefficient,
            "entropy_coefficient": entropy_coefficient, "logits": logits.tolist(),
            "value": value.tolist(), "action": action.tolist(),
            "old_log_prob": old_log_prob.tolist(), "advantage": advantage.tolist(),
            "target": target.tolist(), "parts": {k: v.item() for k, v in parts.items()},
            "dlogits": logits.grad.tolist(), "dvalue": value.grad.tolist()}


def mask_loss(choice):
    """L_TA of a sentence of two clauses and the words between them, which are dark."""
    clause_of, bright = [0] * 4 + [-1] + [1] * 5, [0, 1]
    logits = torch.tensor([choice.gauss(0, 2) for _ in clause_of], requires_grad=True)
    truth = torch.tensor([0.0 if c < 0 else float(bright[c]) for c in clause_of])
    loss = F.binary_cross_entropy_with_logits(logits, truth)
    loss.backward()
    return {"clause_of": clause_of, "bright": bright, "alpha": logits.sigmoid().tolist(),
            "loss": loss.item(), "dlogits": logits.grad.tolist()}


def adam(choice):
    """Five steps with two rates."""
    rates = [1e-3, 2e-3]
    parameters = [torch.tensor([choice.gauss(0, 1) for _ in range(6)], requires_grad=True)
                  for _ in rates]
    before = [p.tolist() for p in parameters]
    optimizer = torch.optim.Adam([{"params": [p], "lr": rate} for p, rate in zip(parameters, rates)],
                                 betas=(0.9, 0.999), eps=1e-5)
    gradients = [[[choice.gauss(0, 0.1) for _ in range(6)] for _ in rates] for _ in range(5)]
    for step in gradients:
        for p, gradient in zip(parameters, step):
            p.grad = torch.tensor(gradient)
        optimizer.step()
    return {"rates": rates, "before": before, "gradients": gradients,
            "after": [p.tolist() for p in parameters]}


def main():
    torch.set_default_dtype(torch.float64)
    content = {"torch": torch.__version__, "python": sys.version.split()[0], "seed": SEED}
    for make in (advantages, ppo_loss, mask_loss, adam):
        content[make.__name__] = make(random.Random(f"{SEED} {make.__name__}"))
    print("{" + ",\n".join(f"{json.dumps(key)}:{json.dumps(value, separators=(',', ':'))}"
                           for key, value in content.items()) + "}")


if __name__ == "__main__":
    main()
