"""The OpenAPI document: the framework's, with the message types that the framework does not see."""

from typing import Any

from fastapi import FastAPI
from fastapi.openapi.utils import get_openapi
from pydantic import BaseModel
from pydantic.json_schema import models_json_schema

import protocol
from server.http.describe import TOKEN_SCHEME

REFERENCE = "#/components/schemas/{model}"


def document(app: FastAPI) -> dict[str, Any]:
    """The document of an app, made once and kept on it."""
    if app.openapi_schema is None:
        app.openapi_schema = _document(app)
    return app.openapi_schema


def _document(app: FastAPI) -> dict[str, Any]:
    made = get_openapi(
        title=app.title,
        version=app.version,
        description=app.description,
        routes=app.routes,
        tags=app.openapi_tags,
    )
    components = made.setdefault("components", {})
    schemas: dict[str, Any] = components.setdefault("schemas", {})
    for name in ("HTTPValidationError", "ValidationError"):
        schemas.pop(name, None)
    _, requests = models_json_schema([(model, "validation") for model in _bodies(made)], ref_template=REFERENCE)
    _, problem = models_json_schema([(protocol.Problem, "serialization")], ref_template=REFERENCE)
    schemas |= problem["$defs"] | schemas | requests["$defs"]
    components["securitySchemes"] = {TOKEN_SCHEME: {"type": "http", "scheme": "bearer"}}
    for operations in made["paths"].values():
        for operation in operations.values():
            _drop_framework_errors(operation["responses"])
            for parameter in operation.get("parameters", ()):
                schema = parameter["schema"] = _without_null(parameter["schema"])
                parameter["required"] = parameter["required"] or schema.get("minItems", 0) > 0
    return made


def _bodies(made: dict[str, Any]) -> list[type[BaseModel]]:
    """The messages that operations take: `describe` names them, and the framework does not look them up."""
    bodies = (each["requestBody"] for path in made["paths"].values() for each in path.values() if "requestBody" in each)
    references = {body["content"]["application/json"]["schema"]["$ref"] for body in bodies}
    return [getattr(protocol, reference.rsplit("/", 1)[-1]) for reference in sorted(references)]


def _without_null(schema: dict[str, Any]) -> dict[str, Any]:
    """A parameter that may be left out is no parameter that may be null."""
    kinds = [kind for kind in schema.get("anyOf", ()) if kind != {"type": "null"}]
    if len(kinds) != 1:
        return schema
    return {**kinds[0], **{name: value for name, value in schema.items() if name != "anyOf"}}


def _drop_framework_errors(responses: dict[str, Any]) -> None:
    """Take out the framework's own 422, which our handlers never answer with."""
    described = str(responses.get("422", ""))
    if "HTTPValidationError" in described:
        del responses["422"]
