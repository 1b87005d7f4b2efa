"""Whatever comes as an array: a right, finite answer, or a ValueError that says what is wrong."""

import copy
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as hnp

from public_arrays import ARGUMENTS, OPTIONAL, OPTIONAL_OF, REQUIRED, Argument

LARGE = 1e6  # m: far beyond any robot, far from overflow
dtypes = ["f8", ">f8", "f4", "f2", "g", "i8", "u1", ">i2", "?", "c16", "O", "U3", "S2", "M8[s]"]
plain = st.sampled_from(
    [
        *(None, "", "abc", "1", b"1", 5, 1.5, True, 10**400, -(2**70), 1j, object(), {}, {1: 2}),
        *({1.0}, [], [[]], [None], [[1.0], [1.0, 2.0]], ["a"] * 9, [10**400] * 9, range(3)),
        (x for x in "ab"),
    ]
)


def shapes_near(shape: tuple[int, ...]) -> st.SearchStrategy[tuple[int, ...]]:
    near = [shape, (0, *shape), (1, *shape), (3, *shape), (2, 1, *shape), shape[::-1], (*shape, 1)]
    return st.sampled_from(near) | hnp.array_shapes(min_dims=0, max_dims=4, min_side=0, max_side=10)


def entries(moderate: bool) -> st.SearchStrategy[float]:
    return (
        st.floats(-LARGE, LARGE) if moderate else st.floats(allow_nan=False, allow_infinity=False)
    )


@st.composite
def arrays(draw: st.DrawFn, argument: Argument) -> np.ndarray:
    """The good value, or something near it: other shapes, entries, dtypes and memory layouts."""
    good = np.asarray(argument.good)
    values = good
    if draw(st.booleans()):
        shape = draw(shapes_near(good.shape))
        values = draw(hnp.arrays(np.float64, shape, elements=entries(argument.moderate)))
    if values.size and draw(st.booleans()):
        values = values.copy()
        spoiled = st.sampled_from([np.nan, np.inf, -np.inf, -1.0, 0.0, 0.5])
        values.flat[draw(st.integers(0, values.size - 1))] = draw(spoiled)
    with np.errstate(all="ignore"):
        values = converted(values, draw(st.sampled_from(dtypes[:1] * 8 + dtypes)))
    layouts = [np.asarray, np.asfortranarray, lambda a: np.asarray(a).tolist(), strided]
    return draw(st.sampled_from(layouts))(values)


def converted(values: np.ndarray, dtype: str) -> np.ndarray:
    if np.dtype(dtype).kind in "iuM":
        values = np.nan_to_num(values, posinf=1, neginf=-1).clip(-100, 100).astype(np.int64)
        values = np.abs(values) if dtype == "u1" else values
    return values.astype(dtype)


def strided(values: np.ndarray) -> np.ndarray:
    """Every other entry of something larger, and read-only."""
    if values.ndim == 0:
        return values
    wide = np.repeat(values, 2, axis=-1)[..., ::2]
    wide.flags.writeable = False
    return wide


def is_right(result: Any, infinite: bool) -> bool:
    return bool((~np.isnan(result) if infinite else np.isfinite(result)).all())


def assert_answered(argument: Argument, value: Any) -> None:
    try:
        result = argument.call(value)
    except ValueError as error:
        said = str(error)
        assert said.startswith(argument.names), said
        assert "got" in said, said
        assert "expected" in said, said
        return
    assert is_right(result, argument.infinite), (value, result)
    if value is not None:
        same = argument.call(np.array(value, dtype=np.float64))
        np.testing.assert_array_equal(result, same)


@pytest.mark.parametrize("argument", ARGUMENTS, ids=lambda a: f"{a.label}-{a.name}")
@given(data=st.data())
def test_arrays(argument: Argument, data: st.DataObject) -> None:
    value = data.draw(arrays(argument))
    before = copy.deepcopy(value)
    assert_answered(argument, value)
    assert repr(value) == repr(before)  # unlike ==, it takes NaN for NaN
    if isinstance(value, np.ndarray) and value.dtype != object:
        assert value.tobytes() == before.tobytes()


@pytest.mark.parametrize("argument", ARGUMENTS, ids=lambda a: f"{a.label}-{a.name}")
@given(value=plain)
def test_what_is_no_array(argument: Argument, value: Any) -> None:
    required = argument.label.startswith(REQUIRED)  # here it has the name of an option
    optional = argument.name in OPTIONAL and not required
    if value is None and (optional or (argument.label, argument.name) in OPTIONAL_OF):
        assert is_right(argument.call(None), argument.infinite)
        return
    assert_answered(argument, value)


@pytest.mark.parametrize("argument", ARGUMENTS, ids=lambda a: f"{a.label}-{a.name}")
def test_the_good_value_is_good(argument: Argument) -> None:
    """So that the tests above can't pass by refusing everything."""
    good = np.asarray(argument.good)
    result = argument.call(good)
    assert is_right(result, argument.infinite)
    np.testing.assert_array_equal(argument.call(good.tolist()), result)
    np.testing.assert_array_equal(argument.call(np.asfortranarray(good)), result)
    np.testing.assert_array_equal(argument.call(good.astype(">f8")), result)


@pytest.mark.parametrize("argument", ARGUMENTS, ids=lambda a: f"{a.label}-{a.name}")
@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_one_number_that_is_not_finite(argument: Argument, bad: float) -> None:
    value = np.array(argument.good, dtype=float)
    value.flat[value.size // 2] = bad
    if argument.infinite and np.isinf(bad) and argument.name != "q":
        assert_answered(argument, value)
        return
    with pytest.raises(ValueError, match=r"^.*: got .*, expected ") as error:
        argument.call(value)
    assert str(error.value).startswith(argument.names)
