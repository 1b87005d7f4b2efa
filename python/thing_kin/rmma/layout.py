"""Text tables."""

from __future__ import annotations

from collections.abc import Sequence


def columns(
    header: Sequence[str], rows: Sequence[Sequence[str]], *, left: int = 1, rule: bool = True
) -> str:
    """Lay out rows below a header, the first `left` columns to the left, others to the right."""
    widths = [max(len(row[k]) for row in [header, *rows]) for k in range(len(header))]
    lines = [_line(row, widths, left) for row in [header, *rows]]
    if rule:
        lines.insert(1, "-" * max(len(line) for line in lines))
    return "\n".join(lines)


def _line(row: Sequence[str], widths: Sequence[int], left: int) -> str:
    cells = [
        cell.ljust(width) if k < left else cell.rjust(width)
        for k, (cell, width) in enumerate(zip(row, widths, strict=True))
    ]
    return "  ".join(cells).rstrip()


def number(value: float, digits: int = 2, *, sign: bool = False) -> str:
    """Write a number, or a dash for NaN; no minus before zero."""
    if value != value:
        return "-"
    return f"{round(value, digits) + 0.0:{'+' if sign else ''}.{digits}f}"


def percent(value: float, digits: int = 1) -> str:
    """Write a share of 1 in percent."""
    return number(100.0 * value, digits)


def millimeters(value: float, digits: int = 1) -> str:
    """Write meters in mm."""
    return number(1e3 * value, digits)
