"""Makes the workbooks of this folder: needs openpyxl and odfpy.

table1.xlsx and table1.ods hold the table of boards/STM32F4DiscoveryBoard/pins.csv. odd.xlsx and
odd.ods hold one of each thing that only a spreadsheet has: a title row, a formula, a merged cell,
a number, a date, an empty row and a sheet without pins.
"""

import csv
import datetime
import pathlib

from odf.opendocument import OpenDocumentSpreadsheet
from odf.table import CoveredTableCell, Table, TableCell, TableRow
from odf.text import P
from openpyxl import Workbook

HERE = pathlib.Path(__file__).parent
BOARD = HERE / "../../../../boards/STM32F4DiscoveryBoard/pins.csv"
DAY = datetime.datetime(2026, 3, 1)


def table1():
    with open(BOARD, newline="", encoding="utf-8") as file:
        return [row for row in csv.reader(file) if row and not row[0].startswith("#")]


def xlsx():
    book = Workbook()
    book.active.title = "Pins"
    for row in table1():
        book.active.append(row)
    book.save(HERE / "table1.xlsx")

    book = Workbook()
    notes = book.active
    notes.title = "Notes"
    notes["B2"] = "nothing about pins"
    sheet = book.create_sheet("Pins")
    sheet["A1"] = "My board"
    sheet.append(["Pin", "Position", "ADC", "I2C"])
    sheet.append(["PA1", 23, '=CONCATENATE("ADC1","_IN1")', "-"])
    sheet.append(["PB6", 92, "-", "I2C1_SCL"])
    sheet.append(["PB7", 93, DAY, ""])
    sheet.append([])
    sheet.append(["PC1", 16, 11, "-"])
    sheet.merge_cells("D4:D5")
    book.save(HERE / "odd.xlsx")


def ods_cell(value):
    if isinstance(value, tuple):
        formula, text = value
        cell = TableCell(valuetype="string", formula=formula, stringvalue=text)
        cell.addElement(P(text=text))
    elif isinstance(value, (int, float)):
        cell = TableCell(valuetype="float", value=value)
        cell.addElement(P(text=str(value)))
    elif isinstance(value, datetime.datetime):
        cell = TableCell(valuetype="date", datevalue=value.date().isoformat())
        cell.addElement(P(text=value.date().isoformat()))
    elif value is None:
        cell = TableCell()
    else:
        cell = TableCell(valuetype="string")
        cell.addElement(P(text=value))
    return cell


def ods_sheet(book, name, rows):
    table = Table(name=name)
    for row in rows:
        line = TableRow()
        for value in row:
            if value == "merged":
                cell = TableCell(valuetype="string", numberrowsspanned=2, numbercolumnsspanned=1)
                cell.addElement(P(text="I2C1_SCL"))
            elif value == "covered":
                cell = CoveredTableCell()
            else:
                cell = ods_cell(value)
            line.addElement(cell)
        table.addElement(line)
    book.spreadsheet.addElement(table)


def ods():
    book = OpenDocumentSpreadsheet()
    ods_sheet(book, "Pins", table1())
    book.save(str(HERE / "table1.ods"))

    book = OpenDocumentSpreadsheet()
    ods_sheet(book, "Notes", [[], [None, "nothing about pins"]])
    formula = ('of:=CONCATENATE("ADC1";"_IN1")', "ADC1_IN1")
    rows = [
        ["My board"],
        ["Pin", "Position", "ADC", "I2C"],
        ["PA1", 23, formula, "-"],
        ["PB6", 92, "-", "merged"],
        ["PB7", 93, DAY, "covered"],
        [],
        ["PC1", 16, 11, "-"],
    ]
    ods_sheet(book, "Pins", rows)
    book.save(str(HERE / "odd.ods"))


xlsx()
ods()
