"""pytest, of docs/test_frameworks.md."""


def test_person(picture):
    picture("person.json", "person")


def test_meeting(answers):
    walk = {"dt": 0.5, "samples": [[0, 0, 0.4], [0.6, 0.1, 0.4], [1.2, 0, 0.4]]}
    agents = [{"name": "A", "clip": "walk"}, {"name": "B", "clip": "walk", "translate": [1, 0]}]
    answers({"clips": {"walk": walk}, "agents": agents, "queries": [{"a": "A", "b": "B"}]}, "meeting")


def test_people(picture):
    people = {"clips": {"walk": {"dt": 0.5, "samples": [[0, 0, 0.4], [0.6, 0.1, 0.4], [1.2, 0, 0.4]]}}}
    picture(people, "walk", view={"levels": 1}, size="320x240")
