"""The OpenAPI document as one page of plain HTML: no script, no style of its own, nothing from another host."""

import json
from collections.abc import Iterable, Iterator, Mapping
from html import escape
from typing import Any, Final

Schema = Mapping[str, Any]

_BOUNDS: Final = {
    "minimum": "at least {}",
    "exclusiveMinimum": "more than {}",
    "maximum": "at most {}",
    "exclusiveMaximum": "less than {}",
    "minLength": "at least {} characters",
    "maxLength": "at most {} characters",
    "minItems": "at least {} of them",
    "maxItems": "at most {} of them",
    "pattern": "matches {}",
}


def reference(document: Mapping[str, Any]) -> str:
    """The page for an OpenAPI document."""
    operations = [
        (method, path, operation)
        for path, methods in document["paths"].items()
        for method, operation in methods.items()
    ]
    schemas = document["components"]["schemas"]
    info = document["info"]
    body = (
        f"<h1>{escape(info['title'])} {escape(info['version'])}: HTTP interface</h1>",
        _prose(info["description"]),
        '<p>The same for programs: <a href="/openapi.json">/openapi.json</a>.</p>',
        '<nav class="contents" aria-label="Operations">',
        *_contents(operations),
        "</nav>",
        "<h2>Operations</h2>",
        *(_operation(*each) for each in operations),
        "<h2>Messages</h2>",
        *(_message(name, schemas[name]) for name in sorted(schemas)),
    )
    return _PAGE.format(title=escape(info["title"]), body="\n".join(body))


_PAGE: Final = """<!doctype html>
<html lang="en">
  <head>
    <meta charset="utf-8">
    <meta name="viewport" content="width=device-width, initial-scale=1">
    <title>{title}: HTTP interface</title>
    <link rel="icon" href="/web/icon.svg" type="image/svg+xml">
    <link rel="stylesheet" href="/web/style.css">
    <link rel="stylesheet" href="/web/reference.css">
  </head>
  <body>
    <header class="bar">
      <a class="brand" href="/"><img src="/web/icon.svg" alt="" width="26" height="26"><span>Pooliad</span></a>
    </header>
    <main class="reference">
{body}
    </main>
  </body>
</html>
"""


def _contents(operations: Iterable[tuple[str, str, Schema]]) -> Iterator[str]:
    """Links to the operations, by their tags."""
    groups: dict[str, list[str]] = {}
    for method, path, operation in operations:
        link = f'<a href="#{_anchor(method, path)}"><code>{method.upper()} {escape(path)}</code></a>'
        text = f"<li>{link} {escape(operation.get('summary', ''))}</li>"
        groups.setdefault(" ".join(operation.get("tags", ("other",))), []).append(text)
    for tag, items in groups.items():
        yield f"<h2>{escape(tag.capitalize())}</h2><ul>{''.join(items)}</ul>"


def _operation(method: str, path: str, operation: Schema) -> str:
    """One request: what it takes and what it is answered with."""
    parts = [
        f'<section id="{_anchor(method, path)}">',
        f"<h3><code>{method.upper()} {escape(path)}</code> {escape(operation.get('summary', ''))}</h3>",
        _prose(operation.get("description", "")),
        "<p>With a token.</p>" if operation.get("security") else "",
    ]
    if parameters := operation.get("parameters"):
        rows = ((_name(each["name"], each), escape(each["in"]), *_about(each["schema"], each)) for each in parameters)
        parts.append(_table(("parameter", "in", "type", "what it is"), rows))
    for kind, content in operation.get("requestBody", {}).get("content", {}).items():
        parts.append(f"<p>Body: <code>{escape(kind)}</code>, {_type(content.get('schema', {}))}</p>")
        examples = content.get("examples", {}).values()
        parts += [f"<pre>{escape(json.dumps(each['value'], ensure_ascii=False))}</pre>" for each in examples]
    parts.append(_table(("status", "answer", "type"), map(_answer, operation["responses"].items())))
    return "\n".join((*parts, "</section>"))


def _answer(item: tuple[str, Schema]) -> tuple[str, ...]:
    status, response = item
    kinds = [f"<code>{escape(kind)}</code> {_type(each.get('schema', {}))}" for kind, each in _content(response)]
    return escape(status), escape(response.get("description", "")), "<br>".join(kinds)


def _content(response: Schema) -> Iterable[tuple[str, Schema]]:
    found: Mapping[str, Schema] = response.get("content", {})
    return found.items()


def _message(name: str, schema: Schema) -> str:
    """A message, or a part of one, with its fields."""
    parts = [f'<section id="{escape(name)}">', f"<h3>{escape(name)}</h3>", _prose(schema.get("description", ""))]
    if properties := schema.get("properties"):
        required = schema.get("required", ())
        rows = (
            (_name(field, {"required": field in required}), *_about(each, each)) for field, each in properties.items()
        )
        parts.append(_table(("field", "type", "what it is"), rows))
    else:
        parts.append(f"<p>{_type(schema)}</p>")
    return "\n".join((*parts, "</section>"))


def _name(name: str, described: Schema) -> str:
    """A field's name, and whether it may be left out."""
    return f"<code>{escape(name)}</code>" + ("" if described.get("required") else " (optional)")


def _about(schema: Schema, described: Schema) -> tuple[str, str]:
    """A field's type, and what is known of it besides."""
    default = [f"default {_value(schema['default'])}"] if "default" in schema else []
    text = " ".join(str(described.get("description", "")).split())
    return _type(schema), ". ".join([*([escape(text.rstrip("."))] if text else []), *default])


def _type(schema: Schema) -> str:
    """A type in words, those with a name of their own as links."""
    if "$ref" in schema:
        name = escape(schema["$ref"].rpartition("/")[2])
        return f'<a href="#{name}">{name}</a>'
    for key in ("anyOf", "oneOf", "allOf"):
        if key in schema:
            return " or ".join(_type(each) for each in schema[key])
    if "const" in schema:
        return _value(schema["const"])
    if "enum" in schema:
        return " or ".join(_value(each) for each in schema["enum"])
    bounds = [escape(words.format(schema[name])) for name, words in _BOUNDS.items() if name in schema]
    if "prefixItems" in schema:
        return "[" + ", ".join(_type(each) for each in schema["prefixItems"]) + "]"
    return ", ".join([_plain_type(schema), *bounds])


def _plain_type(schema: Schema) -> str:
    kind = schema.get("type", "any value")
    if isinstance(kind, list):
        return " or ".join(kind)
    if kind == "array":
        return f"list of {_type(schema.get('items', {}))}"
    values = schema.get("additionalProperties")
    if kind == "object" and isinstance(values, Mapping):
        return f"object of {_type(values)}"
    return escape(str(kind))


def _value(value: Any) -> str:
    return f"<code>{escape(json.dumps(value, ensure_ascii=False))}</code>"


def _prose(text: str) -> str:
    """Paragraphs, lines as they are."""
    return "".join(f"<p>{escape(part).strip()}</p>" for part in text.split("\n\n") if part.strip())


def _table(heads: Iterable[str], rows: Iterable[Iterable[str]]) -> str:
    head = "".join(f'<th scope="col">{escape(each)}</th>' for each in heads)
    body = "".join(f"<tr>{''.join(f'<td>{cell}</td>' for cell in row)}</tr>" for row in rows)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _anchor(method: str, path: str) -> str:
    """What an operation's place on the page is called."""
    return escape(f"{method}{path}".replace("/", "-").replace("{", "").replace("}", ""))
