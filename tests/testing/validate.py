#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""Judges JSON documents by JSON Schemas, by an implementation that is not hexcal's.

validate.py FILE: FILE holds {"schemas": {name: schema}, "cases": [{"schema": name, "document": ...}]}.
Prints a line a case: nothing where the document is valid, else where it is not and why. A schema
that is none, by its own metaschema, ends it with status 1.
"""

import json
import sys

from jsonschema import Draft202012Validator


def judge(validator, document):
    errors = sorted(validator.iter_errors(document), key=lambda error: list(map(str, error.path)))
    if not errors:
        return ""
    error = errors[0]
    place = "/".join(map(str, error.path))
    return f"{place}: {error.message}".replace("\n", " ")[:300]


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        work = json.load(file)
    validators = {}
    for name, schema in work["schemas"].items():
        Draft202012Validator.check_schema(schema)
        validators[name] = Draft202012Validator(schema)
    for case in work["cases"]:
        print(judge(validators[case["schema"]], case["document"]))


if __name__ == "__main__":
    main()
