"""The JSON Schema of scenario files, for editors."""

from __future__ import annotations

import json
from typing import Any

from umbilical.scenario.scenario import Scenario


def json_schema() -> dict[str, Any]:
    """JSON Schema of a scenario file, for editors.

    Which keys are required depends on what ``extends`` brings along, which a schema cannot follow; it checks
    names, types and bounds, and loading checks the rest.
    """
    schema = Scenario.model_json_schema()
    required = schema["required"]
    schema = _relaxed(schema)
    for definition in schema["$defs"].values():
        if "file" in definition.get("properties", {}):
            definition["properties"]["file"]["anyOf"].insert(0, {"type": "string"})  # its name alone
    schema["properties"]["extends"] = {"type": "string", "description": "preset that this scenario changes"}
    schema["anyOf"] = [{"required": ["extends"]}, {"required": required}]
    return {"$schema": "https://json-schema.org/draft/2020-12/schema", **schema}


def schema_text() -> str:
    """The JSON Schema as it is published in ``docs/scenario.schema.json``."""
    return json.dumps(json_schema(), indent=2, ensure_ascii=False) + "\n"


def _relaxed(schema: Any) -> Any:
    if isinstance(schema, list):
        return [_relaxed(item) for item in schema]
    if not isinstance(schema, dict):
        return schema
    kept = {"anyOf" if key == "oneOf" else key: _relaxed(item) for key, item in schema.items() if key != "required"}
    kept.pop("discriminator", None)
    return kept
