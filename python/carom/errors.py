# SPDX-License-Identifier: MIT
"""What carom raises. A motion that ends early is no error: its status says why."""


class InputError(ValueError):
    """Misuse or bad input.

    `where` is a JSON pointer or an argument ("/bodies/2/mass", "times"), "" if the message says it; `message` has what was
    found and what was expected.
    """

    def __init__(self, where: str, message: str) -> None:
        super().__init__(where, message)
        self.where = where
        self.message = message

    def __str__(self) -> str:
        return f"{self.where}: {self.message}" if self.where else self.message


class FormatError(InputError):
    """A file or text that cannot be read or written; `file` is its path as it was given."""

    def __init__(self, file: str, where: str, message: str) -> None:
        super().__init__(where, message)
        self.args = (file, where, message)  # from which it is pickled
        self.file = file

    def __str__(self) -> str:
        return f"{self.file}: {super().__str__()}"


class NotComputable(ArithmeticError):
    """Numerical failure of a derivative: an overflow, 0/0, or a step limit. A simulation ends with a status instead."""
