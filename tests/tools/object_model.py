# SPDX-FileCopyrightText: 2026 The Reckon authors
# SPDX-License-Identifier: Apache-2.0
"""Checks that the object model is well formed, and that every name in it is defined: object_model.py FILE"""
import re
import sys
import xml.etree.ElementTree as ElementTree

SPACE = "{http://standards.ieee.org/IEEE1516-2010}"
# Data types and representations of the standard's own module.
STANDARD = {"HLAoctet", "HLAASCIIchar", "HLAfloat32BE", "HLAfloat64BE", "HLAinteger16BE", "HLAinteger32BE", "HLAinteger64BE"}
ORDER = ["modelIdentification", "objects", "interactions", "dataTypes"]


def text(element, name):
    found = element.find(SPACE + name)
    assert found is not None and found.text, f"{element.tag} without {name}: {ElementTree.tostring(element)[:200]}"
    return found.text


def unique(elements, what):
    names = [text(element, "name") for element in elements]
    twice = {name for name in names if names.count(name) > 1}
    assert not twice, f"{what} twice: {twice}"
    wrong = [name for name in names if not re.fullmatch(r"[A-Za-z_][\w-]*", name)]
    assert not wrong, f"no names for {what}: {wrong}"
    return set(names)


def main(path):
    root = ElementTree.parse(path).getroot()
    assert root.tag == SPACE + "objectModel", root.tag
    assert [child.tag[len(SPACE):] for child in root] == ORDER, [child.tag for child in root]
    types = root.find(SPACE + "dataTypes")
    kinds = ["simpleData", "enumeratedData", "arrayData", "fixedRecordData"]
    known = unique([e for kind in kinds for e in types.iter(SPACE + kind)], "data types") | STANDARD
    basic = unique(types.iter(SPACE + "basicData"), "representations") | STANDARD
    for element in root.iter(SPACE + "dataType"):
        assert element.text in known, f"data type {element.text} is nowhere"
    for element in root.iter(SPACE + "representation"):
        assert element.text in basic, f"representation {element.text} is nowhere"
    for element in types.iter(SPACE + "enumeratedData"):
        unique(element.iter(SPACE + "enumerator"), text(element, "name"))
    for element in types.iter(SPACE + "fixedRecordData"):
        unique(element.iter(SPACE + "field"), text(element, "name"))

    classes = {text(e, "name"): e for e in root.iter(SPACE + "objectClass")}
    assert {"HLAobjectRoot", "Entity", "Platform"} <= set(classes), set(classes)
    attributes = {text(a, "name"): text(a, "dataType") for a in classes["Entity"].findall(SPACE + "attribute")}
    assert attributes["entity_location"] == "WorldCoordinates" and "force_model" in attributes, attributes
    interactions = {text(e, "name"): e for e in root.iter(SPACE + "interactionClass")}
    parameters = {text(p, "name"): text(p, "dataType") for p in interactions["Fire"].findall(SPACE + "parameter")}
    units = {text(e, "name"): text(e, "units") for e in types.iter(SPACE + "simpleData")}
    assert units[parameters["range"]] == "m", parameters
    velocity = next(e for e in types.iter(SPACE + "fixedRecordData") if text(e, "name") == parameters["velocity"])
    assert {units[text(f, "dataType")] for f in velocity.findall(SPACE + "field")} == {"m/s"}
    print(f"{len(classes)} object classes, {len(interactions)} interactions, {len(known) - len(STANDARD)} data types")


main(sys.argv[1])
