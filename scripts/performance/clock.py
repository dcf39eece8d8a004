"""What the peers share: the clock, and a last line like that of our own `bench`."""
import json
import time


def run(unit, count_some, seconds):
    """Calls count_some(), which returns how much it did, until the time is up; one JSON line."""
    count, wall, cpu = 0, time.perf_counter(), time.process_time()
    while time.perf_counter() - wall < seconds:
        count += count_some()
    print(json.dumps({unit: count, "cpu_seconds": time.process_time() - cpu,
                      "wall_seconds": time.perf_counter() - wall}))
