"""Interleaved timing: neighbors' load hits all contenders alike, so that ratios hold."""

import gc
import os
import time
from collections import deque
from collections.abc import Callable, Mapping, Sequence
from itertools import cycle, islice
from typing import Any

Call = tuple[Callable[[Any], Any], Sequence[Any]]  # a function, and inputs to cycle through
BATCH_SECONDS = 0.01  # long against the clock's resolution and the loop's start


def pin_to_one_cpu() -> int | None:
    """Keep the process on one CPU; None where the system can't."""
    if not hasattr(os, "sched_setaffinity"):
        return None
    cpu = max(os.sched_getaffinity(0))
    os.sched_setaffinity(0, {cpu})
    return cpu


def batch(call: Call, calls: int) -> float:
    """CPU seconds of one call, over `calls` of them; map and deque loop in C."""
    function, inputs = call
    arguments = islice(cycle(inputs), calls)
    start = time.process_time_ns()
    deque(map(function, arguments), maxlen=0)
    return (time.process_time_ns() - start) * 1e-9 / calls


def adapted(call: Call) -> int:
    """How many calls make a batch; finding out also warms up."""
    calls = 1
    while True:
        took = batch(call, calls) * calls
        if took >= BATCH_SECONDS / 4:
            return max(1, round(calls * BATCH_SECONDS / took))
        calls *= 4


def interleaved(contenders: Mapping[str, Call], rounds: int) -> dict[str, list[float]]:
    """Seconds of one call in each round, A B A B ..., each round begun by another contender."""
    names = list(contenders)
    sizes = {name: adapted(contenders[name]) for name in names}
    times: dict[str, list[float]] = {name: [] for name in names}
    gc.collect()
    gc.disable()
    try:
        for i in range(rounds):
            for name in names[i % len(names) :] + names[: i % len(names)]:
                times[name].append(batch(contenders[name], sizes[name]))
    finally:
        gc.enable()
    return times
