"""Sphinx: `./dev docs` builds these pages with -W into build/docs; nothing is fetched."""

import re
from pathlib import Path

_pyproject = (Path(__file__).parent.parent / "pyproject.toml").read_text()
_version = re.search(r'^version = "(.+?)"', _pyproject, re.MULTILINE)
assert _version is not None

project = "thing_kin"
author = "thing_kin developers"
project_copyright = author
version = release = _version[1]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "sphinx.ext.napoleon"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 3
exclude_patterns = ["_build"]

html_theme = "furo"
html_title = f"{project} {version}"

napoleon_google_docstring = False
napoleon_use_param = False  # as text: "(n,)" is a shape, not a class to link to
napoleon_use_rtype = False
autodoc_member_order = "bysource"
autoclass_content = "both"  # the constructor's signature, too
autodoc_typehints = "none"  # pybind11's own signatures carry them


def plain_text(
    app: object, what: str, name: str, obj: object, options: object, lines: list[str]
) -> None:
    """Keep what docstrings mean as text from being read as markup."""
    for i, line in enumerate(lines):
        if not line.lstrip().startswith((">>>", "...")):
            lines[i] = line.replace("|", r"\|")  # |dq| is a norm, not a substitution
        if what == "property":
            lines[i] = lines[i].replace(": ", " = ")  # napoleon takes it for "type: description"


SHORTER = (
    (r"self: [\w.]+(, )?", ""),
    (r"typing\.SupportsFloat \| typing\.SupportsIndex", "float"),
    (r"typing\.SupportsInt \| typing\.SupportsIndex", "int"),
    (r"numpy\.typing\.NDArray\[numpy\.float64\]", "ndarray"),
    (r"\b(thing_kin\._core|numpy\.typing|collections\.abc)\.", ""),
)


def shorter(
    app: object,
    what: str,
    name: str,
    obj: object,
    options: object,
    arguments: str | None,
    returns: str | None,
) -> tuple[str | None, str | None]:
    """Leave out of pybind11's signatures what only a type checker wants to know."""
    for pattern, replacement in SHORTER:
        arguments = arguments and re.sub(pattern, replacement, arguments)
        returns = returns and re.sub(pattern, replacement, returns)
    return arguments, returns


def setup(app) -> None:
    """Connect the hooks, the first before napoleon's."""
    app.connect("autodoc-process-docstring", plain_text, priority=100)
    app.connect("autodoc-process-signature", shorter)
