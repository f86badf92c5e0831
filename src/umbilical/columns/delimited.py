"""Text of numbers in columns, as spreadsheets and loggers write it."""

from __future__ import annotations

import re
from datetime import UTC, datetime
from itertools import compress

import numpy as np

from umbilical.errors import FileError

_WITH_UNIT = re.compile(r"(?P<name>.*?)\s*[\[(](?P<unit>[^\[\]()]*)[\])]\s*")
_NUMBER = re.compile(r"[+-]?(\d+\.?\d*|\.\d+)([eE][+-]?\d+)?")
_DAY_FIRST = re.compile(r"(?P<day>\d{1,2})\.(?P<month>\d{1,2})\.(?P<year>\d{4})(?P<rest>([ T]\d{1,2}:.*)?)")
_BLANK = ("", "nan", "na", "n/a", "null", "#n/a", "-")
_MARKS = "'\""
Parsed = tuple[tuple[str, ...], dict[str, str], dict[str, np.ndarray], frozenset[str], np.ndarray]


def decode(content: bytes, origin: str) -> str:
    """Text of bytes in UTF-8 (with or without a byte-order mark), UTF-16 or the code page of Western spreadsheets."""
    if content.startswith((b"\xff\xfe", b"\xfe\xff")):
        return content.decode("utf-16", errors="replace")
    if b"\0" in content[:4096]:
        raise FileError(f"{origin}: this is neither text nor NetCDF; a spreadsheet can save it as CSV")
    try:
        return content.decode("utf-8-sig")
    except UnicodeDecodeError:
        return content.decode("cp1252", errors="replace")


def parse_delimited(text: str, origin: str) -> Parsed:
    """Names, units, values, names of columns that are dates, and line numbers; columns of words are left out.

    Raises:
        FileError: there is no header or no row, a row has another number of cells, or a cell is no number.

    >>> names, units, values, _, _ = parse_delimited("t [s];sway [m]\\n0,0;0,5\\n0,1;0,7\\n", "file")
    >>> names, units["sway"], values["sway"].tolist()
    (('t', 'sway'), 'm', [0.5, 0.7])
    """
    comments, rows = _rows(text)
    if len(rows) < 2:
        raise FileError(f"{origin}: holds no rows of numbers under a line of names")
    (first, header), *body = rows
    if all(_is_number(cell) for cell in header):
        reason = "begin with a line of names and units, e.g. time [s],sway [m]"
        raise FileError(f"{origin}: line {first} holds numbers and names no column; {reason}")
    names, units = _named(header)
    if _is_units(body[0][1], len(header)) and len(body) > 1:
        units, body = dict(zip(names, body[0][1], strict=True)), body[1:]
    elif comments and len(comments) == len(header) and not any(units.values()):
        units = dict(zip(names, comments, strict=True))
    if len(set(names)) < len(names):
        twice = next(name for name in names if names.count(name) > 1)
        raise FileError(f"{origin}: two columns are called {twice!r}")
    _check_lengths(names, body, origin)
    numbers = _of_numbers([row for _, row in body])
    names = tuple(compress(names, numbers))
    values, dates = _values(names, [(line, [*compress(row, numbers)]) for line, row in body], origin)
    units = {name: "s" if name in dates else units[name].strip("[]() ") for name in names}
    return names, units, values, dates, np.array([line for line, _ in body])


def _check_lengths(names: tuple[str, ...], body: list[tuple[int, list[str]]], origin: str) -> None:
    for line, row in body:
        if len(row) != len(names):
            reason = "decimal commas need semicolons or tabulators between columns"
            raise FileError(f"{origin}: line {line} has {len(row)} cells and the header {len(names)}; {reason}")


def _of_numbers(rows: list[list[str]]) -> list[bool]:
    """Which columns hold numbers or dates, or nothing; all of them, if less than two would be left."""
    kept = []
    for column in zip(*rows, strict=True):
        cells = [cell for cell in column if cell.lower() not in _BLANK]
        kept.append(not cells or any(_is_number(cell) or _date(cell) is not None for cell in cells))
    return kept if sum(kept) >= 2 else [True] * len(kept)


def _rows(text: str) -> tuple[list[str], list[tuple[int, list[str]]]]:
    """Cells of the last comment above the header, and of every other line with its number."""
    comment: list[str] = []
    lines: list[tuple[int, str]] = []
    separator = ""
    for number, line in enumerate(text.splitlines(), start=1):
        bare = line.strip()
        if not bare.strip(",;\t") or (bare.lower().startswith("sep=") and not lines):
            continue
        if bare.startswith("#"):
            comment = comment if lines else [cell.strip() for cell in bare.lstrip("# ").split(",")]
            continue
        separator = separator or next((mark for mark in ";\t," if mark in bare), " ")
        lines.append((number, bare if separator == " " else line.rstrip("\r\n")))
    return comment, _cells(lines, separator)


def _cells(lines: list[tuple[int, str]], separator: str) -> list[tuple[int, list[str]]]:
    split = [(n, line.split() if separator == " " else line.split(separator)) for n, line in lines]
    cells = [(n, [cell.strip().strip(_MARKS).strip() for cell in row]) for n, row in split]
    if separator == "," or not any(_comma(cell) for _, row in cells[1:] for cell in row):
        return cells
    # One decimal comma makes all points thousands: those are left to be refused.
    return [cells[0], *((n, [_decimal(cell) for cell in row]) for n, row in cells[1:])]


def _comma(cell: str) -> bool:
    return "," in cell and _is_number(cell.replace(",", "."))


def _decimal(cell: str) -> str:
    if _comma(cell):
        return cell.replace(",", ".")
    return f"{cell} (in a file with decimal commas)" if "." in cell and _is_number(cell) else cell


def _is_number(cell: str) -> bool:
    return _NUMBER.fullmatch(cell) is not None


def _is_units(row: list[str], count: int) -> bool:
    values = (_is_number(cell) or cell.lower() in _BLANK[1:-1] or _date(cell) for cell in row)
    return len(row) == count and not any(values)


def _named(header: list[str]) -> tuple[tuple[str, ...], dict[str, str]]:
    found = [_WITH_UNIT.fullmatch(cell) for cell in header]
    names = tuple(match["name"] if match else cell for match, cell in zip(found, header, strict=True))
    return names, {name: match["unit"] if match else "" for name, match in zip(names, found, strict=True)}


def _values(
    names: tuple[str, ...], body: list[tuple[int, list[str]]], origin: str
) -> tuple[dict[str, np.ndarray], frozenset[str]]:
    values, dates = np.full((len(names), len(body)), np.nan), set[str]()
    for k, (line, row) in enumerate(body):
        for j, cell in enumerate(row):
            if _is_number(cell):
                values[j, k] = float(cell)
            elif cell.lower() not in _BLANK:
                if (found := _date(cell)) is None:
                    reason = (
                        f"{cell!r} is neither a number nor a date such as 2026-03-01T12:00:00.5 or 01.03.2026 12:00"
                    )
                    raise FileError(f"{origin}: line {line}, {names[j]}: {reason}")
                values[j, k] = found
                dates.add(names[j])
    return dict(zip(names, values, strict=True)), frozenset(dates)


def _date(cell: str) -> float | None:
    """Seconds since 1970 of a date and time: ISO 8601, or 31.12.2026 23:59; without a zone it is taken as UTC."""
    if turned := _DAY_FIRST.fullmatch(cell):
        hours = re.sub(r"^[ T](?=\d:)", " 0", turned["rest"])
        cell = f"{turned['year']}-{int(turned['month']):02d}-{int(turned['day']):02d}{hours}"
    try:
        found = datetime.fromisoformat(cell)
    except ValueError:
        return None
    return (found if found.tzinfo else found.replace(tzinfo=UTC)).timestamp()
