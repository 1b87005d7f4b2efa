"""From answers to figures: shares in percent, times in seconds."""

from typing import Any

import numpy as np

from inverse.field import Course

POINTS = 200  # of a curve at most


def times(name: str, values: Any) -> dict[str, float]:
    return {
        f"{name}_median": float(np.median(values)),
        f"{name}_mean": float(np.mean(values)),
        f"{name}_p99": float(np.quantile(values, 0.99)),
    }


def curve(seconds: Any, right: Any) -> list[list[float]]:
    """Time, and the percentage of all targets that were solved within it."""
    solved = np.sort(seconds[right])
    if not len(solved):
        return []
    at = np.unique(np.linspace(0, len(solved) - 1, POINTS).astype(int))
    return [[float(solved[i]), 100.0 * (i + 1) / len(right)] for i in at]


def figures(course: Course, answers: list[Any]) -> dict[str, Any]:
    """Judged by Pinocchio; times are those of all targets, solved or not."""
    claims = np.array([claim for _, claim, _, _ in answers])
    cpu, wall = (np.array([answer[i] for answer in answers]) for i in (2, 3))
    right = np.array(
        [
            course.judge.is_right(q, T)
            for (q, *_), T in zip(answers, course.targets[: len(answers)], strict=True)
        ]
    )
    return {
        "count": len(answers),
        "success": 100.0 * float(right.mean()),
        "claimed": 100.0 * float(claims.mean()),
        "wrong_claims": 100.0 * float((claims & ~right).mean()),
        "unclaimed": 100.0 * float((right & ~claims).mean()),
        **times("cpu", cpu),
        **times("wall", wall),
        "curve": curve(cpu, right),
    }
