"""Tables."""

from __future__ import annotations

import csv
import html
import io
from collections.abc import Iterable, Mapping
from typing import Any

import numpy as np
import numpy.typing as npt

#: Rows of a table that a notebook shows.
SHOWN = 10


class Table(dict[str, npt.NDArray[Any]]):
    """Columns by name, NumPy arrays of one length, with the unit in the name; numbers are float64, what is not there is NaN.

    ``pandas.DataFrame(table)`` and ``polars.DataFrame(table)`` take it.
    """

    @classmethod
    def of_csv(cls, text: str) -> Table:
        """The table of a CSV text: numbers where a whole column is numbers or empty, else text."""
        head, *rows = csv.reader(io.StringIO(text))
        return cls((name, _column([row[i] for row in rows])) for i, name in enumerate(head))

    @classmethod
    def of_rows(cls, rows: Iterable[Mapping[str, Any]]) -> Table:
        """The table of objects with the same keys; ``None`` becomes NaN."""
        rows = list(rows)
        names = rows[0] if rows else ()
        return cls((name, np.array([np.nan if row[name] is None else row[name] for row in rows])) for name in names)

    @property
    def rows(self) -> int:
        """How many rows there are."""
        return len(next(iter(self.values()), ()))

    def to_csv(self) -> str:
        """As the text of a CSV file: NaN is empty."""
        out = io.StringIO()
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(self)
        writer.writerows([_cell(column[i]) for column in self.values()] for i in range(self.rows))
        return out.getvalue()

    def __repr__(self) -> str:
        return f"<squeezefilm.Table {self.rows} rows: {', '.join(self)}>"

    def _repr_html_(self) -> str:
        return rows_html(self, ([_cell(column[i]) for column in self.values()] for i in range(min(self.rows, SHOWN)))) + (
            f"<p>… {self.rows} rows</p>" if self.rows > SHOWN else ""
        )


def rows_html(head: Iterable[str], rows: Iterable[Iterable[Any]]) -> str:
    """A table for a notebook."""

    def line(cells: Iterable[Any], tag: str) -> str:
        shown = (f"{cell:.6g}" if isinstance(cell, float) else html.escape(str(cell)) for cell in cells)
        return "<tr>" + "".join(f"<{tag}>{cell}</{tag}>" for cell in shown) + "</tr>"

    return "<table>" + line(head, "th") + "".join(line(row, "td") for row in rows) + "</table>"


def _cell(value: Any) -> Any:
    if isinstance(value, (float, np.floating)):
        return "" if np.isnan(value) else float(value)
    return value


def _column(values: list[str]) -> npt.NDArray[Any]:
    try:
        return np.array([float(value) if value else np.nan for value in values])
    except ValueError:
        return np.array(values)
