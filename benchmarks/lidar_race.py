"""Scan matching beside peers, the same scans in one run: errors against exact truth, CPU time.

    python benchmarks/lidar_race.py [--pairs 120] [--seconds 20] [--only-peers]

Peers are from PyPI: small-gicp, kiss-icp, scipy. Each is first tried with several voxel sizes and
reaches on other scans of the same kinds, and runs with what lost least, then erred least. Scans of
a pair are up to 0.3 m and 0.3 rad apart, the guess is zero; a match that is wrong by over 0.1 m or
3 degrees is lost, and errors are of what was not lost. Times are CPU time of one thread,
from ranges to pose; over pairs the contenders take turns.
"""

import argparse
import sys
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import numpy as np

from lidar_peers import PEERS, Array, Ours, Peer
from timing import pin_to_one_cpu

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "tests"))

from scan_drives import SENSORS, Sensor, between, pair, record
from scan_worlds import FAMILIES

NAMES = ("180 beams, 180 degrees", "361 beams, 180 degrees", "1081 beams, 270 degrees")
KINDS = ("room", "corridor, doors", "corridor, pillars", "pillars", "glass", "people")
LOST = (0.1, np.radians(3.0))


def pairs_of(sensor: Sensor, count: int, seed: int) -> list[Any]:
    """As many of each kind."""
    rng = np.random.default_rng(seed)
    return [pair(FAMILIES[KINDS[k % len(KINDS)]](rng), sensor, rng) for k in range(count)]


def errors_of(found: Array, truth: Array) -> Array:
    """Metres and radians, (..., 2)."""
    rest = between(truth, found)
    return np.stack([np.hypot(rest[..., 0], rest[..., 1]), np.abs(rest[..., 2])], axis=-1)


def is_lost(errors: Array) -> Array:
    return ~(errors < LOST).all(axis=-1)


def timed(call: Callable[[], Array]) -> tuple[Array, float]:
    start = time.thread_time_ns()
    found = call()
    return found, (time.thread_time_ns() - start) * 1e-3


def best_of(kind: type[Peer], sensor: Sensor, pairs: list[Any]) -> Peer:
    """The candidate with the fewest lost, then with the least median error."""

    def score(peer: Peer) -> tuple[float, float]:
        errors = errors_of(np.array([peer.match(p.a, p.b) for p in pairs]), truth)
        return float(is_lost(errors).mean()), float(np.median(errors[:, 0]))

    truth = np.array([p.truth for p in pairs])
    return min(kind.candidates(sensor), key=score)


def best_follower(kind: type[Peer], sensor: Sensor, drives: list[Any]) -> Peer:
    """The candidate that drifts least."""

    def score(peer: Peer) -> float:
        return float(np.mean([drift(list(peer.follow(d.scans)), d) for d in drives]))

    return min(kind.candidates(sensor), key=score)


def drift(poses: list[Array], drive: Any) -> float:
    """Metres at the end."""
    truth = between(drive.poses[0], drive.poses[-1])
    return float(errors_of(poses[-1], truth)[0])


def race_pairs(name: str, contenders: list[Peer], count: int) -> None:
    pairs = pairs_of(SENSORS[name], count, seed=2)
    truth = np.array([p.truth for p in pairs])
    found: dict[str, list[Array]] = {peer.name: [] for peer in contenders}
    took: dict[str, list[float]] = {peer.name: [] for peer in contenders}
    for k, two in enumerate(pairs):
        for peer in contenders[k % len(contenders) :] + contenders[: k % len(contenders)]:
            pose, micro = timed(lambda p=peer, t=two: p.match(t.a, t.b))
            found[peer.name].append(pose)
            took[peer.name].append(micro)
    print(f"\n### Pairs, {name}, {count} pairs\n")
    print("| matcher | lost | mm median | 95 % | max | mrad median | 95 % | µs | options |")
    print("|---|" + "---:|" * 7 + "---|")
    for peer in contenders:
        errors = errors_of(np.array(found[peer.name]), truth)
        lost = is_lost(errors)
        kept = 1e3 * errors[~lost] if (~lost).any() else np.full((1, 2), np.nan)
        (half, most), top = np.percentile(kept, (50, 95), axis=0), kept.max(axis=0)
        print(
            f"| {peer.name} | {100 * lost.mean():.1f} % | {half[0]:.1f} | {most[0]:.1f} "
            f"| {top[0]:.0f} | {half[1]:.1f} | {most[1]:.1f} | {np.median(took[peer.name]):.0f} "
            f"| {peer.options or ''} |"
        )
        if isinstance(peer, Ours):
            said = int(np.sum(lost & np.array(peer.unsure)))
            print(f"<!-- thing_kin: {said} of {lost.sum()} lost said so -->")


def race_drives(name: str, contenders: list[Peer], drives: list[Any], rate: float) -> None:
    print(f"\n### Drives, {name}, {rate:.0f} Hz, {len(drives)} drives\n")
    print("| odometry | steps lost | mm a step, median | 95 % | end, m median | max | µs a scan |")
    print("|---|" + "---:|" * 6)
    for peer in contenders:
        steps, ends, took = [], [], []
        for drive in drives:
            follower, poses = peer.follow(drive.scans), []
            for _ in drive.scans:
                pose, micro = timed(lambda f=follower: next(f))
                poses.append(pose)
                took.append(micro)
            path = np.array(poses)
            steps.append(errors_of(between(path[:-1], path[1:]), drive.motions()))
            ends.append(drift(poses, drive))
        errors = np.vstack(steps)
        half, most = 1e3 * np.percentile(errors[:, 0], (50, 95))
        micro = float(np.median(took))
        print(
            f"| {peer.name} | {is_lost(errors).sum()} of {len(errors)} | {half:.1f} | {most:.1f} "
            f"| {np.median(ends):.3f} | {np.max(ends):.2f} | {micro:.0f} |"
        )
        if isinstance(peer, Ours):
            share = np.mean(took) * 1e-6 * 40
            print(f"<!-- thing_kin: {100 * share:.1f} % of a core at 40 Hz -->")


def drives_of(sensor: Sensor, seconds: float, rate: float, seed: int) -> list[Any]:
    """One of each kind."""
    rng = np.random.default_rng(seed)
    return [record(FAMILIES[kind](rng), sensor, rng, seconds, rate) for kind in KINDS]


def main() -> None:
    parser = argparse.ArgumentParser(description=(__doc__ or "").split("\n")[0])
    parser.add_argument("--pairs", type=int, default=120)
    parser.add_argument("--seconds", type=float, default=20.0)
    parser.add_argument("--only-peers", action="store_true")
    parser.add_argument("--only-ours", action="store_true")
    arguments = parser.parse_args()
    pin_to_one_cpu()
    kinds = () if arguments.only_ours else PEERS
    for name in NAMES:
        sensor = SENSORS[name]
        ours: list[Peer] = [] if arguments.only_peers else [Ours(sensor)]
        tuning = pairs_of(sensor, max(6, arguments.pairs // 4), seed=1)
        peers = [best_of(kind, sensor, tuning) for kind in kinds]
        race_pairs(name, [*ours, *peers], arguments.pairs)
        rate = 40.0 if sensor.n > 1000 else 10.0
        short = drives_of(sensor, arguments.seconds / 4, 10.0, seed=3)
        peers = [best_follower(kind, sensor, short) for kind in kinds]
        for one in ours:
            one.period = 1.0 / rate
        drives = drives_of(sensor, arguments.seconds, rate, seed=4)
        race_drives(name, [*ours, *peers], drives, rate)


if __name__ == "__main__":
    main()
