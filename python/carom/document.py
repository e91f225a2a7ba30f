# SPDX-License-Identifier: MIT
"""Scene documents from what Python holds: dicts with lists, tuples, NumPy's arrays and numbers."""

import json
import math
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from carom.errors import InputError


def _plain(value: Any, pointer: str) -> Any:
    """The value as json writes it. Raises InputError with the pointer of what JSON cannot hold."""
    if isinstance(value, np.ndarray | np.generic):
        value = value.tolist()
    if value is None or isinstance(value, bool | int | str):
        return value
    if isinstance(value, float):
        if not math.isfinite(value):
            raise InputError(pointer, f"found {value}, expected a finite number")
        return value
    if isinstance(value, Mapping):
        for key in value:
            if not isinstance(key, str):
                raise InputError(pointer, f"found the key {key!r}, expected text")
        return {key: _plain(inner, f"{pointer}/{key}") for key, inner in value.items()}
    if isinstance(value, Sequence) and not isinstance(value, bytes | bytearray):
        return [_plain(inner, f"{pointer}/{i}") for i, inner in enumerate(value)]
    raise InputError(pointer, f"found {value!r} of the type {type(value).__name__}, expected what JSON can hold")


def to_text(document: Mapping[str, Any] | str) -> str:
    """The JSON text of a document; a text is taken as it is."""
    if isinstance(document, str):
        try:
            document.encode()
        except UnicodeEncodeError as error:
            raise InputError("", f"found {document[error.start]!r}, half of a character, expected text") from None
        return document
    if not isinstance(document, Mapping):
        raise TypeError(f"a scene is made from a dict or a JSON text, not from {type(document).__name__}")
    return json.dumps(_plain(document, ""))
