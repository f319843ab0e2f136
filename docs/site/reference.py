# SPDX-License-Identifier: BSD-3-Clause
"""The reference pages of the site, from what the program says of itself: 'hexcal help' and
'hexcal schema'."""

import html
import json
import re
import subprocess

FORMAT_WORDS = {"string": "text", "number": "number", "integer": "whole number", "boolean": "true or false",
                "null": "null", "object": "mapping", "array": "list"}


def output_of(program, *arguments):
    return subprocess.run([program, *arguments], check=True, stdout=subprocess.PIPE,
                          encoding="utf-8").stdout


def commands_of(program):
    """The names in the list of commands that 'hexcal help' prints."""
    block = output_of(program, "help").split("\nCommands\n")[1].split("\n\n")[0]
    names = [line.split()[0] for line in block.splitlines()]
    return [name for name in names if name != "help"]


def prose(text):
    """A text of the program as HTML: flags as code, pages of docs/ as links."""
    text = html.escape(text, quote=False)
    text = re.sub(r"(?<![\w-])(--[a-z]\w*)", r'<code class="flag">\1</code>', text)
    return re.sub(r"docs/(\w+)\.md", r'<a href="../\1.html">\g<0></a>', text)


def paragraphs(lines):
    """Text of a description: paragraphs, and lines that stand two columns in as lists."""
    page, open_tag = [], None
    for line in lines:
        tag = "li" if line.startswith(" ") else "p"
        if tag == "p" and open_tag != "p":
            page.append("</li></ul>" * (open_tag == "li") + "<p>")
        elif tag == "li" and not line.startswith("   "):
            page.append("</p><ul><li>" if open_tag == "p" else "</li><li>" if open_tag else "<ul><li>")
        page.append(prose(line.strip()))
        open_tag = tag
    return "\n".join(page) + ("</p>" if open_tag == "p" else "</li></ul>")


def section(heading, lines):
    """A section of a help text: what stands two columns in is explained by what stands six in."""
    is_example = heading == "Examples"
    page, details = [f"<h3>{html.escape(heading)}</h3>", "<dl>"], []

    def close():
        if details:
            text = "\n".join(details)
            page.append(f"<dd><pre><code>{html.escape(text, quote=False)}</code></pre></dd>" if is_example
                        else f"<dd>{prose(text)}</dd>")
            details.clear()

    terms = []
    for line in lines:
        if line.startswith("      "):
            if terms:
                text = html.escape(" ".join(terms), quote=False)
                page.append(f"<dt>{text}</dt>" if is_example else f"<dt><code>{text}</code></dt>")
                terms.clear()
            details.append(line[6:])
        else:
            close()
            terms.append(line.strip())
    close()
    assert not terms, terms
    return "\n".join(page) + "\n</dl>"


def words(text):
    return re.sub(r"\s+", "", text)


def command_help(text):
    """The help of one command as HTML; nothing of it may get lost."""
    usage, *blocks = text.strip().split("\n\n")
    page = [f"<pre><code>{html.escape(usage, quote=False)}</code></pre>"]
    for block in blocks:
        lines = block.split("\n")
        is_section = len(lines) > 1 and (lines[0] == "Examples" or lines[1].startswith("  --"))
        page.append(section(lines[0], lines[1:]) if is_section else paragraphs(lines))
    page = "\n".join(page)
    if words(html.unescape(re.sub(r"<[^>]*>", "", page))) != words(text):
        raise RuntimeError("help is not laid out as expected:\n" + text)
    return page


def commands_page(program):
    overview = html.escape(output_of(program, "help"), quote=False)
    names = commands_of(program)
    overview = re.sub(rf"^  ({'|'.join(names)})\b", r'  <a href="#\1">\1</a>', overview, flags=re.M)
    page = ["<h1>What the program says of its commands</h1>",
            "<p>The output of <code>hexcal help</code> and <code>hexcal help COMMAND</code>.</p>",
            f"<pre><code>{overview}</code></pre>"]
    for name in names:
        page += [f'<h2 id="{name}">{name}</h2>', command_help(output_of(program, "help", name))]
    return "\n".join(page)


def code(value):
    return f"<code>{html.escape(str(value), quote=False)}</code>"


def limits(schema):
    """Of a number, of a list's length: from .. to .."""
    parts = []
    for key, word in (("minimum", "from"), ("exclusiveMinimum", "above"), ("maximum", "to"),
                      ("exclusiveMaximum", "below")):
        if key in schema:
            parts.append(f"{word} {schema[key]:g}")
    return (" " + " ".join(parts)) if parts else ""


class Schema:
    """A JSON Schema as tables: a row a key, a table for each of its definitions."""

    def __init__(self, name, schema):
        self.name, self.root, self.rows = name, schema, []

    def type_of(self, schema):
        """What a value may be, in words and links."""
        if "$ref" in schema:
            name = schema["$ref"].split("/")[-1]
            return f'<a href="#{self.name}-{name}">{html.escape(name)}</a>'
        if "const" in schema:
            return code(json.dumps(schema["const"], ensure_ascii=False).strip('"'))
        if "enum" in schema:
            values = dict.fromkeys(str(value) for value in schema["enum"])
            return ", ".join(code(value) for value in values)
        for key in ("oneOf", "anyOf"):
            if any("type" in part or "$ref" in part or "const" in part for part in schema.get(key, [])):
                return " <em>or</em> ".join(self.type_of(part) for part in schema[key])
        kinds = schema.get("type", "any")
        kinds = kinds if isinstance(kinds, list) else [kinds]
        if set(kinds) >= {"string", "number", "boolean"}:
            kinds = ["string"] + ["null"] * ("null" in kinds)
        if kinds == ["array"]:
            low, high = schema.get("minItems"), schema.get("maxItems")
            count = f"{low} " if low is not None and low == high else f"at least {low} " if low else ""
            items = self.type_of(schema.get("items", {}))
            return "list" if items == "any" else f"list of {count}{items}"
        if kinds == ["object"] and isinstance(schema.get("additionalProperties"), dict):
            return "mapping of names to " + self.type_of(schema["additionalProperties"])
        return " or ".join(FORMAT_WORDS.get(kind, kind) for kind in kinds) + limits(schema)

    def add(self, path, schema, required):
        note = prose(schema.get("description", ""))
        key = code(path) + (' <span class="required">required</span>' if required else "")
        self.rows.append(f"<tr><td>{key}</td><td>{self.type_of(schema)}</td><td>{note}</td></tr>")
        self.walk(path, schema)

    def walk(self, path, schema):
        """The keys below a mapping, or below the mappings of a list."""
        if "$ref" in schema:
            return
        if "items" in schema:
            self.walk(path + "[]", schema["items"])
        for part in schema.get("oneOf", []) + schema.get("anyOf", []):
            if "properties" in part and "type" in part:
                self.walk(path, part)
        if isinstance(schema.get("additionalProperties"), dict):
            self.walk(path + ".*" if path else "*", schema["additionalProperties"])
        for key, value in schema.get("properties", {}).items():
            self.add(f"{path}.{key}" if path else key, value, key in schema.get("required", []))
        for key, value in schema.get("patternProperties", {}).items():
            self.add(f"{path}.{key.strip('^$')}" if path else key.strip("^$"), value, False)

    def table(self, schema):
        self.rows = []
        self.walk("", schema)
        return ('<table class="keys"><thead><tr><th>key</th><th>is</th><th></th></tr></thead><tbody>\n'
                + "\n".join(self.rows) + "\n</tbody></table>") if self.rows else ""

    def page(self):
        parts = [self.table(self.root)]
        for name, schema in self.root.get("$defs", {}).items():
            note = prose(schema.get("description", ""))
            parts.append(f'<h3 id="{self.name}-{name}">{html.escape(name)}</h3>\n'
                         f"<p>{self.type_of(schema)}{'. ' + note if note else ''}</p>\n"
                         + self.table(schema))
        return "\n".join(parts)


def schemas_of(program):
    """{name: (what it describes, schema)} of what 'hexcal schema' lists."""
    rows = [line.split(None, 1) for line in output_of(program, "schema").splitlines() if line.strip()]
    return {name: (text, json.loads(output_of(program, "schema", name))) for name, text in rows}


def formats_page(schemas):
    page = ["<h1>Files, key by key</h1>",
            "<p>What <code>hexcal schema</code> says. A list's entries are written <code>[]</code>, names that are "
            "free <code>*</code>. Where keys depend on each other, the JSON Schema has the whole truth.</p>",
            "<ul>"]
    page += [f'<li><a href="#{name}">{name}</a>: {prose(text)}</li>'
             for name, (text, _) in schemas.items()]
    page.append("</ul>")
    for name, (text, schema) in schemas.items():
        page.append(f'<h2 id="{name}">{name}</h2>\n<p>{prose(text)}. '
                    f'<a href="schema/{name}.json">JSON Schema</a></p>')
        if name != "settings":  # the flags, which the page of commands has
            page.append(Schema(name, schema).page())
    return "\n".join(page)
