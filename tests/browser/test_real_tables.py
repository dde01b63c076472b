"""Issue 15, "Everything that shows": tables with jaws on the page; where its lines are, what may lie between them."""

import random

import pytest

import physics
from client import notation

NAMED = ("nine_foot", "eight_foot", "seven_foot")
OWN = physics.Table.nine_foot().replace(corner_mouth=0.13, side_mouth=0.12, horn_radius=0.012, corner_cut=139.0)
"""Its shape is no named table's: the page has to ask for it."""
LIES = """async ([table, places]) => {
  const { askShape } = await import("/web/tables.js");
  const { isInside } = await import("/web/placement.js");
  await askShape(table);
  return places.map(([x, y]) => isInside(table, x, y));
}"""
LINES = """async (table) => {
  const { askShape } = await import("/web/tables.js");
  const { jawLine } = await import("/web/jaw_ground.js");
  const shape = await askShape(table);
  return shape.pockets.map(({ jaws }) => jaws.map(jawLine));
}"""
PIXELS = """async ([table, places]) => {
  const { TablePicture } = await import("/web/table_picture.js");
  const { askShape } = await import("/web/tables.js");
  await askShape(table);
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const picture = new TablePicture(canvas, table);
  picture.fit(900, 1700);
  picture.draw({ balls: new Map() });
  return places.map(([x, y]) => {
    const [px, py] = picture.projection.place(x, y);
    const at = [px, py].map((part) => Math.round(part * picture.density));
    return [...context.getImageData(...at, 1, 1).data];
  });
}"""


def tables():
    return [*(physics.Table.named(name) for name in NAMED), OWN]


@pytest.mark.parametrize("table", tables(), ids=lambda table: f"{table.name} {table.corner_mouth}")
def test_the_page_lets_balls_lie_where_the_physics_does(page, server, table):
    """In front of the noses and in the mouths up to the drop edge: 30,000 places about the mouths, and all over."""
    page.goto(server.url)
    chance = random.Random(3)
    middles = table.mouths.tolist()
    places = [[x + chance.uniform(-0.1, 0.1), y + chance.uniform(-0.1, 0.1)] for x, y in middles for _ in range(5000)]
    places += [[chance.uniform(-0.2, table.width + 0.2), chance.uniform(-0.2, table.length + 0.2)] for _ in range(5000)]
    shown = page.evaluate(LIES, [table.to_dict(), places])
    truth = [bool(table.contains(x, y)) for x, y in places]
    assert shown == truth
    rho = table.contact_distance
    beyond = [not (rho <= x <= table.width - rho and rho <= y <= table.length - rho) for x, y in places]
    assert sum(may and out for may, out in zip(truth, beyond, strict=True)) > 500, "some lie in the jaws"


@pytest.mark.parametrize("table", tables(), ids=lambda table: f"{table.name} {table.corner_mouth}")
def test_horns_are_drawn_as_arcs_between_nose_and_facing(page, server, table):
    page.goto(server.url)
    drawn = page.evaluate(LINES, table.to_dict())
    for pocket, lines in zip(table.pockets, drawn, strict=True):
        for jaw, line in zip(pocket.jaws, lines, strict=True):
            assert line[0] == pytest.approx(jaw.nose_end, abs=1e-12)
            assert line[-2] == pytest.approx(jaw.facing_start, abs=1e-12)
            assert tuple(line[-1]) == jaw.facing_end
            for x, y in line[:-1]:
                away = ((x - jaw.horn_centre[0]) ** 2 + (y - jaw.horn_centre[1]) ** 2) ** 0.5
                assert away == pytest.approx(jaw.horn_radius, abs=1e-12)
            chord = sum((b - a) ** 2 for a, b in zip(jaw.nose_end, jaw.tip, strict=True)) ** 0.5
            x, y = line[len(line) // 2]
            assert ((x - jaw.tip[0]) ** 2 + (y - jaw.tip[1]) ** 2) ** 0.5 < chord, "the shorter arc"


@pytest.mark.parametrize("table", tables(), ids=lambda table: f"{table.name} {table.corner_mouth}")
def test_holes_and_cushions_are_drawn_where_they_are(page, server, table):
    """Black within the drop edge, cloth just before it, cushion behind noses and facings: read off the pixels."""
    page.goto(server.url)
    step = 0.006
    for pocket in table.pockets:
        hole, middle = pocket.hole_centre, [sum(parts) / 2 for parts in zip(*pocket.mouth, strict=True)]
        away = ((middle[0] - hole[0]) ** 2 + (middle[1] - hole[1]) ** 2) ** 0.5
        inwards = [(b - a) / away for a, b in zip(hole, middle, strict=True)]
        edge = [hole[axis] + pocket.hole_radius * inwards[axis] for axis in (0, 1)]
        before = [edge[axis] + step * inwards[axis] for axis in (0, 1)]
        within = [edge[axis] - step * inwards[axis] for axis in (0, 1)]
        behind = []
        for jaw in pocket.jaws:
            half = [(a + b) / 2 for a, b in zip(jaw.facing_start, jaw.facing_end, strict=True)]
            behind.append([a - step * n for a, n in zip(half, jaw.facing_normal, strict=True)])
        hole_colour, cloth, *cushions = page.evaluate(PIXELS, [table.to_dict(), [within, before, *behind]])
        assert max(hole_colour[:3]) < 40, (pocket.name, hole_colour)
        assert cloth[1] > 60, (pocket.name, cloth)
        assert cloth[1] > 1.5 * cloth[0]
        for colour in cushions:
            assert 40 < colour[1] < 110, (pocket.name, colour)
            assert colour[1] > 1.5 * colour[0]


IN_HAND = """async ([table, area, places]) => {
  const { TablePicture } = await import("/web/table_picture.js");
  const { askShape } = await import("/web/tables.js");
  await askShape(table);
  const canvas = document.createElement("canvas");
  const context = canvas.getContext("2d", { willReadFrequently: true });
  const picture = new TablePicture(canvas, table);
  picture.fit(900, 1700);
  const pixels = (scene) => {
    picture.draw({ balls: new Map(), ...scene });
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    return places.map(([x, y]) => {
      const [column, row] = picture.projection.place(x, y).map((part) => Math.round(part * picture.density));
      return data[4 * (row * canvas.width + column)];
    });
  };
  const plain = pixels({});
  return pixels({ area }).map((red, place) => red > plain[place]);
}"""


@pytest.mark.parametrize("area", ["anywhere", "kitchen"])
@pytest.mark.parametrize("table", tables(), ids=lambda table: f"{table.name} {table.corner_mouth}")
def test_where_a_ball_in_hand_may_lie_is_lighter_in_the_mouths_too(page, server, table, area):
    """Seen: the rectangle alone was, though a cue ball in hand goes into the jaws. 1,500 places that are clear."""
    page.goto(server.url)
    chance, edge = random.Random(5), 0.004
    where = {"name": area, **dict(zip("xy", bounds(table, area), strict=True))}
    around = [(0, -edge), (0, edge), (-edge, 0), (edge, 0)]
    places, truth = [], []
    for _ in range(1500):
        middle = table.mouths.tolist()[chance.randrange(6)]
        x, y = middle[0] + chance.uniform(-0.1, 0.1), middle[1] + chance.uniform(-0.1, 0.1)
        lies = {
            bool(table.contains(x + dx, y + dy)) and (area == "anywhere" or y + dy > where["y"][0]) for dx, dy in around
        }
        if len(lies) == 1:
            places.append((x, y))
            truth.append(lies.pop())
    shown = page.evaluate(IN_HAND, [table.to_dict(), where, places])
    wrong = [place for place, light, may in zip(places, shown, truth, strict=True) if light != may]
    assert wrong == []
    rho = table.contact_distance
    assert sum(may and not (rho <= x <= table.width - rho) for (x, _), may in zip(places, truth, strict=True)) > 2


def bounds(table, area):
    """The rectangle that a view tells."""
    rho = table.contact_distance
    low = 0.75 * table.length if area == "kitchen" else rho
    return [rho, table.width - rho], [low, table.length - rho]


def test_a_live_game_says_on_which_table_it_is_played(page, server, play):
    match = server.match(table="nine_foot")
    play(match, 2)
    page.goto(f"{server.url}/#/games/{match.game}")
    page.get_by_text("nine-foot table").wait_for()
    page.goto(f"{server.url}/#/matches/{match.id}")
    page.get_by_text("nine-foot table").wait_for()
    page.goto(f"{server.url}/#/")
    page.locator("a.thumbnail").first.wait_for()


def test_a_changed_table_says_what_is_changed(page, server):
    match = server.match(table={"name": "seven_foot", "mu_slide": 0.25, "corner_mouth": 0.13})
    page.goto(f"{server.url}/#/matches/{match.id}")
    page.get_by_text("seven-foot table, own corner mouth, mu slide").wait_for()


def test_an_event_says_on_which_table_it_is_played(page, server):
    players = {name: server.register()["agent"]["id"] for name in ("ann", "bob")}
    terms = {"name": "Jaws", "entrants": list(players), "pairs": 1, "seed": 5, "table": {"name": "eight_foot"}}
    event = server.send("POST", "/v1/tournaments", json={"terms": terms, "agents": players}).json()
    page.goto(f"{server.url}/#/tournaments/{event['id']}")
    page.get_by_text("eight-foot table").wait_for()


def signed_in(page, server, at):
    player = server.register()
    page.goto(server.url)
    page.evaluate(
        "([token, agent]) => { sessionStorage.setItem('pooliad.token', token);"
        " sessionStorage.setItem('pooliad.agent', JSON.stringify(agent)); }",
        [player["token"], player["agent"]],
    )
    page.goto(f"{server.url}/#/{at}")
    page.reload()
    return player


def test_a_table_is_chosen_for_a_challenge(page, server):
    me, other = signed_in(page, server, "play"), server.register()
    page.get_by_label("Kind of table").select_option("seven_foot")
    page.get_by_label("Name of the player").fill(other["agent"]["name"])
    page.get_by_role("button", name="Challenge").click()
    page.get_by_text("Waiting for the opponent").wait_for()
    (match,) = server.http.get(f"/v1/matches?agent={me['agent']['id']}").json()["matches"]
    assert match["table"] == physics.Table.seven_foot().to_dict()


def test_the_laboratory_takes_every_table_with_its_ranges(page, server):
    """The sliders go as far as the table does; a ball is put in the jaws; text names the table."""
    signed_in(page, server, "lab")
    speed, height = page.get_by_label("Cue speed, m/s, slider"), page.get_by_label("Cue raised, degrees, slider")
    kind = page.get_by_label("Kind of table")
    kind.wait_for()
    assert kind.locator("option").count() == 5
    assert (speed.get_attribute("max"), height.get_attribute("max")) == ("10", "70")
    kind.select_option("nine_foot")
    assert (speed.get_attribute("max"), height.get_attribute("max")) == ("12", "85")
    jaws = (0.026, 0.06)
    assert physics.Table.nine_foot().contains(*jaws)
    assert jaws[0] < physics.Table.nine_foot().contact_distance, "nearer to the nose's line than a ball may come"
    page.get_by_label("Text").fill(notation.write(physics.TableState.from_positions({0: (0.6, 0.6), 5: jaws})))
    page.get_by_role("button", name="Set up from the notation").click()
    page.get_by_label("Direction, degrees", exact=True).fill("225")
    page.get_by_label("Direction, degrees", exact=True).press("Tab")
    page.get_by_label("Cue speed, m/s", exact=True).fill("11.5")
    page.get_by_label("Cue speed, m/s", exact=True).press("Tab")
    page.get_by_text("events in").wait_for()
    page.get_by_label("Format").select_option("Python")
    assert "physics.Table.nine_foot()" in page.get_by_label("Text").input_value()
    assert "v=11.5" in page.get_by_label("Text").input_value()
    kind.select_option("olympiad")
    page.get_by_label("Format").select_option("JSON")
    page.wait_for_function("document.querySelector('textarea.code').value.includes('\"v\":10,')")


def test_a_miscue_is_foretold_and_told(page, server, play):
    signed_in(page, server, "lab")
    page.get_by_label("Kind of table").select_option("nine_foot")
    page.get_by_label("Side, mm (right is positive)", exact=True).fill("21")
    page.get_by_label("Side, mm (right is positive)", exact=True).press("Tab")
    page.get_by_text("miscue: the tip slips").wait_for()
    match = server.match(table="nine_foot", noise={"level": 0.0})
    shot = {"v": 9.0, "phi": 270.0, "theta": 20.0, "a": 25.0, "b": 0.0}
    view = server.http.get(f"/v1/games/{match.game}").json()["view"]
    stroke = {"shot": shot, "call": None, "cue_ball": [0.635, 2.1]}
    headers = {"If-Match": f'"{view["version"]}"'}
    token = match.tokens[view["turn"]]
    assert server.send("POST", f"/v1/games/{match.game}/shots", token, json=stroke, headers=headers).status_code == 200
    page.goto(f"{server.url}/#/games/{match.game}")
    page.locator(".row .tag", has_text="miscue").wait_for()
    page.get_by_text("the tip slipped off the cue ball").wait_for()
