"""models/: the weights of the first seed of some rows, with a card each."""
import json

from measure import Failure
from runs import plan
from weights import weights_only

CARD = """# {model}

{about}; `{config}`, seed {seed}, {frames:,} frames. Weights alone: enough for `eval` and
`train --init`, not for `--resume`.

    build/release/bin/{train}
    build/release/bin/eval --checkpoint models/{model}.safetensors{options}

| environment | policy | episodes | success | reward |
| --- | --- | --- | --- | --- |
{rows}

[docs/results.md](../docs/results.md) has all seeds of this row, `{row}`.
"""


def write(rows, out, scale, target):
    """Copies what is trained; says what is not."""
    wanted = [row for row in rows if row.model]
    written = 0
    for row in wanted:
        steps = [s for s in plan([row], out, scale) if s.seed == row.seeds[0]]
        training = next(s for s in steps if s.kind == "train")
        if not all(s.finished() for s in steps):
            print(f"{row.model}: row {row.name} is not finished; nothing written")
            continue
        target.mkdir(parents=True, exist_ok=True)
        (target / f"{row.model}.safetensors").write_bytes(weights_only(training.result.read_bytes()))
        evaluation = row.evaluations[0]
        records = json.loads((training.folder / f"{evaluation.name}.json").read_text())["settings"]
        (target / f"{row.model}.md").write_text(CARD.format(
            model=row.model, about=row.about[0].upper() + row.about[1:], config=f"configs/{row.config}",
            seed=training.seed, frames=int(training.work), row=row.name,
            train=f"train {' '.join(training.arguments)} --threads {training.finished()['threads']}",
            options=f" {evaluation.options}" if evaluation.options else "",
            rows="\n".join(f"| {r['env']} | {r['policy']} | {r['episodes']} "
                           f"| {100 * r['success_rate']:.1f} % | {r['mean_reward']:.3f} |"
                           for r in records)))
        written += 1
        print(f"written: {target / row.model}.safetensors")
    if not written:
        raise Failure(f"none of the rows {', '.join(row.name for row in wanted)} is finished in {out}")
