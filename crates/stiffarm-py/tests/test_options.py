"""Every verb takes the options of the program, under their names and with their defaults."""

import inspect

import pytest
import stiffarm
from stiffarm import StiffarmError, _options, cluster

VERBS = {
    "robots list": stiffarm.robots, "rank": stiffarm.rank, "place": stiffarm.place, "map": stiffarm.map,
    "compliance": stiffarm.compliance, "study": stiffarm.study, "compare": stiffarm.compare, "identify": stiffarm.identify,
    "measure": stiffarm.measure, "modes": stiffarm.modes, "chatter": stiffarm.chatter, "calibrate": stiffarm.calibrate, "robots verify": stiffarm.verify,
}  # fmt: skip


@pytest.mark.parametrize("verb", VERBS)
def test_every_option_of_the_program_is_a_keyword_with_its_default_and_its_help(verb):
    function = VERBS[verb]
    keywords = inspect.signature(function).parameters
    for option in _options.table(verb).values():
        assert option.keyword in keywords and option.keyword in function.__doc__, option
        if not option.is_required and option.keyword not in ("robots", "tasks", "robot", "data"):
            assert keywords[option.keyword].default == option.value, option
    assert "{options}" not in function.__doc__


def test_defaults_are_values_of_python():
    assert stiffarm.study() == stiffarm.study(**{row.keyword: row.value for row in _options.table("study").values()})
    assert _options.table("study")["range"].value == "0.5..1.5" and _options.table("study")["ratios"].value == (0.8, 1.0, 1.2)
    assert _options.table("map")["size"].value == 400 and _options.table("place")["force_n"].value == 1000.0


def test_an_unknown_keyword_is_named_with_one_that_is_near():
    for call, arguments in ((stiffarm.place, {"task": "A:0.3"}), (stiffarm.rank, {}), (stiffarm.map, {}), (stiffarm.cell, {"task": "A:0.3"})):
        with pytest.raises(TypeError, match="tolerence_mm.*did you mean tolerance_mm|tolerence_mm"):
            call("BT200L", tolerence_mm=2, **arguments)
    with pytest.raises(TypeError, match="tolerence_mm"):
        cluster.sweep("BT200L", folder="nowhere", tolerence_mm=2)


def test_rank_takes_the_filters_of_the_catalogue(program):
    among = stiffarm.robots(vendor="kuka", payload_kg=(200, None))
    found = stiffarm.rank(vendor="kuka", payload_kg="200..", tasks="A:0.3")
    assert found == stiffarm.rank(among, tasks="A:0.3") and 1 < len(found) == len(among)
    asked = ["--robots", "all", "--vendor", "kuka", "--payload-kg", "200..", "--task", "A:0.3"]
    assert found.to_dict() == program("rank", *asked)
    # Of robots that are named it takes those that have it.
    assert [row["robot"] for row in stiffarm.rank("paper", architecture="quasi-serial", tasks="A:0.3").rows] == [
        row["robot"] for row in stiffarm.rank(tasks="A:0.3").rows if row["architecture"] == "quasi-serial"
    ]
    with pytest.raises(StiffarmError, match="nobody"):
        stiffarm.rank(vendor="nobody")


def test_a_map_of_one_posture_is_that_of_the_program(program):
    found = stiffarm.map("BT200L", model="spatial", size=20, posture="front,up,no-flip")
    assert found.to_dict() == program("map", "BT200L", "--model", "spatial", "--size", "20", "--posture", "front,up,no-flip")
    assert {word for row in found.posture for word in row if word} == {"front, elbow up, no flip"}
