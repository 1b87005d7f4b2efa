"""Importing a peer when it is needed, and saying what to install if it is not there."""

from importlib import import_module
from typing import Any


def peer(module: str, package: str) -> Any:
    """Import a module, or raise an ImportError that names its package."""
    try:
        return import_module(module)
    except ImportError as error:
        raise ImportError(f"this needs {module}: pip install {package}") from error
