// Moves the picture of this page: reads the data in it, works out every pose, follows hand and keys.
// A point is [x, y] in pixels of the picture, y down; `phase` is the input's clock in radians.
"use strict";
(() => {
  const page = JSON.parse(document.getElementById("data").textContent);
  const byId = (id) => document.getElementById(id);
  const SVG = "http://www.w3.org/2000/svg";
  const GRID = 65536;
  const STEP = Math.PI / 180;
  const TURN = 2 * Math.PI;
  page.period = TURN * Math.round(page.period / TURN);  // with all its digits

  // --- small arithmetic -------------------------------------------------------------------------

  const mod = (a, b) => a - b * Math.floor(a / b);
  const add = (a, b) => [a[0] + b[0], a[1] + b[1]];
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1]];
  const mul = (a, b) => [a[0] * b[0] - a[1] * b[1], a[0] * b[1] + a[1] * b[0]];
  const by = (a, k) => [a[0] * k, a[1] * k];
  const size = (a) => Math.hypot(a[0], a[1]);
  const unit = (a) => { const long = size(a); return long > 0 ? by(a, 1 / long) : [1, 0]; };
  const xy = (a) => a[0].toFixed(4) + " " + a[1].toFixed(4);
  const line = (points) => "M" + points.map(xy).join("L");
  const clamp = (x, low, high) => Math.min(Math.max(x, low), high);
  const minus = (text) => text.replaceAll("-", "−");
  const short = (x) => minus(String(Number(x.toPrecision(4))));

  const NUMBERS = { u1: Uint8Array, u2: Uint16Array, i4: Int32Array, f4: Float32Array, f8: Float64Array };
  function unpacked(text, kind = "f4") {
    const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
    return new NUMBERS[kind](bytes.buffer);
  }

  // --- the motion -------------------------------------------------------------------------------

  // A point's nodes, and between two of them the polynomial of fifth degree that has place, velocity
  // and acceleration (by radian of phase) at both ends.
  class Track {
    constructor([nodes, places, rates, [x, y, grain]]) {
      this.nodes = unpacked(nodes, "u2");
      this.places = unpacked(places, "i4");
      this.rates = unpacked(rates, "f4");
      this.first = [x, y];
      this.grain = grain;
    }

    // Returns {p, v, a} at a phase; on a way back that was the way there with velocities of the other sign.
    at(phase) {
      const there = mod(phase - page.way * Math.PI, page.period), back = page.way !== null && there > page.period / 2;
      const { p, v, a } = this.found(back ? page.period - there : there);
      return { p, v: back ? by(v, -1) : v, a };
    }

    found(phase) {
      const { nodes } = this, count = nodes.length;
      const here = mod(phase / page.period, 1) * GRID;
      let low = 0, high = count;
      while (high - low > 1) {
        const middle = (low + high) >> 1;
        if (nodes[middle] <= here) low = middle; else high = middle;
      }
      if (page.way !== null && count > 1) low = Math.min(low, count - 2);
      const next = (low + 1) % count;
      const span = low + 1 < count ? nodes[next] - nodes[low] : GRID - nodes[low] + nodes[0];
      const width = span * page.period / GRID;
      const share = mod(here - nodes[low], GRID) / span;
      const x = this.component(low, next, 0, width, share);
      const y = this.component(low, next, 1, width, share);
      return { p: [x[0], y[0]], v: [x[1], y[1]], a: [x[2], y[2]] };
    }

    component(i, j, axis, h, u) {
      const { places, rates, grain } = this;
      const begin = places[2 * i + axis], p = this.first[axis] + begin * grain, way = (places[2 * j + axis] - begin) * grain;
      const v = rates[4 * i + axis] * h, w = rates[4 * j + axis] * h;
      const a = rates[4 * i + 2 + axis] * h * h / 2, b = rates[4 * j + 2 + axis] * h * h / 2;
      const c3 = 10 * way - 6 * v - 4 * w - 3 * a + b;
      const c4 = -15 * way + 8 * v + 7 * w + 3 * a - 2 * b;
      const c5 = 6 * way - 3 * (v + w) - a + b;
      return [
        p + u * (v + u * (a + u * (c3 + u * (c4 + u * c5)))),
        (v + u * (2 * a + u * (3 * c3 + u * (4 * c4 + u * 5 * c5)))) / h,
        (2 * a + u * (6 * c3 + u * (12 * c4 + u * 20 * c5))) / (h * h),
      ];
    }
  }

  // A table of values over a period in parts, each with its own equal steps from `ends` to `ends`, read between its
  // entries: by the cubic through the four nearest, beside one that there is none of by a line.
  function reading(table, { ends, steps }, share) {
    let part = 0, begin = 0;
    while (part < steps.length - 1 && share >= ends[part + 1]) begin += steps[part++] + 1;
    const count = steps[part], place = clamp((share - ends[part]) / (ends[part + 1] - ends[part]), 0, 1) * count;
    const near = Math.min(Math.floor(place), count - 1), u = place - near;
    const first = clamp(near - 1, 0, count - 3), t = place - first;
    const [a, b, c, d] = table.subarray(begin + first, begin + first + 4);
    const cubic = (t - 1) * (t - 2) * (d * t - a * (t - 3)) / 6 + t * (t - 3) * (b * (t - 2) - c * (t - 1)) / 2;
    const [one, other] = table.subarray(begin + near, begin + near + 2);
    return Number.isFinite(cubic) ? cubic : u === 0 ? one : u === 1 ? other : one * (1 - u) + other * u;
  }

  // Returns how far along a period a phase is, 0 to 1. The end of a way that is gone back belongs to the way there.
  function shareOf(phase) {
    const there = mod(phase, page.period);
    return (page.retraced && there === Math.PI ? there * (1 - 1e-12) : there) / page.period;
  }

  // What a table's values are times that grow without bound towards its poles.
  function weight(poles, phase) {
    let product = 1;
    for (let n = 0; n < poles.length; n += 2) {
      const far = Math.abs(Math.sin((phase / page.period - poles[n]) * Math.PI));
      product *= (far < 1e-14 ? 0 : far) ** poles[n + 1];
    }
    return product;
  }
  const grown = (value, { poles }, phase) => poles ? value / weight(poles, phase) : value;

  const motionIsFine = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  // a low page, as in a slide's frame, leaves its room to the mechanism: numbers and chart come when asked for
  const isLow = matchMedia("(max-height: 30rem) and (min-width: 34rem)").matches;
  const state = {
    phase: 0, playing: motionIsFine, pace: 1, way: 1, side: 0, last: 1,
    trace: true, velocity: false, acceleration: false, names: true, pointer: null, held: null,
    values: !isLow, curves: !isLow,
  };
  const speed = () => page.speed * state.way;

  // --- what moves: each kind gets its group, and gives what puts it at a pose ---------------------

  // What is set already is left alone: what stands still costs a frame nothing.
  const put = (node, name, value) => {
    if (node.getAttribute(name) !== String(value)) node.setAttribute(name, value);
  };
  const say = (node, text) => { if (node.textContent !== text) node.textContent = text; };
  const part = (group, name, attributes) => {
    const made = group.appendChild(document.createElementNS(SVG, name));
    for (const key in attributes) made.setAttribute(key, attributes[key]);
    return made;
  };
  const stroked = (group, colour, width, more) =>
    part(group, "path", { fill: "none", stroke: colour, "stroke-width": width, "stroke-linejoin": "round", ...more });
  const matrix = (turn, at) =>
    `matrix(${turn[0].toFixed(8)} ${turn[1].toFixed(8)} ${(-turn[1]).toFixed(8)} ${turn[0].toFixed(8)} ${xy(at)})`;

  // Returns what tells how strongly a name or a dimension line shows now.
  function strengthOf(shown) {
    const table = unpacked(shown, "u1"), count = table.length;
    return () => {
      const moment = mod(state.phase / page.period, 1) * count, first = Math.floor(moment) % count;
      const strength = (table[first] + (moment % 1) * (table[(first + 1) % count] - table[first])) / 255;
      return state.names && strength > 0.05 ? strength.toFixed(2) : 0;
    };
  }

  const KINDS = {
    part(group, { at, tail, head, shown }) {
      const still = tail === head, strength = shown && strengthOf(shown);
      return (place) => {
        if (strength) put(group, "opacity", strength());
        const turn = still ? [1, 0] : unit(sub(place(head), place(tail)));
        put(group, "transform", matrix(turn, place(at)));
      };
    },

    label(group, { at, head, begin, end, off, size: sides, share, aside, further, scale, bar, shown }) {
      const strength = strengthOf(shown);
      return (place) => {
        const span = at === head ? [scale, 0] : sub(place(head), place(at));
        const along = mul(sub(end, begin), span);
        const normal = mul([0, 1], unit(along));
        const clear = 0.5 * (Math.abs(normal[0]) * sides[0] + Math.abs(normal[1]) * sides[1]) + 1.3 * bar;
        const foot = add(add(place(at), mul(begin, span)), by(along, share));
        const middle = add(add(foot, by(normal, aside * (clear + further))), off);
        put(group, "transform", `translate(${xy(middle)})`);
        put(group, "opacity", strength());
      };
    },

    coil(group, { between, radius, lead, coils, widths, tilt, colours }) {
      const back = stroked(group, colours[0], widths[0]);
      const edge = stroked(group, colours[1], widths[1], { "stroke-linecap": "round" });
      const core = stroked(group, colours[2], widths[2], { "stroke-linecap": "round" });
      const half = (from, foot, pitch, turn) => Array.from({ length: 13 }, (_, n) => {
        const along = from + n / 24, way = TURN * along - Math.PI / 2;
        return add(foot, mul(turn, [pitch * along + radius * tilt * Math.cos(way), radius * Math.sin(way)]));
      });
      return (place) => {
        const start = place(between[0]), end = place(between[1]);
        const span = size(sub(end, start)), turn = unit(sub(end, start));
        const ends = Math.min(lead, 0.2 * span), pitch = (span - 2 * ends) / coils;
        const led = (from, way) => line(Array.from({ length: 13 }, (_, n) => {
          const share = n / 12;
          return add(from, mul(turn, [way * ends * share, -radius * share * share * (3 - 2 * share)]));
        }));
        let far = "", near = led(start, 1) + led(end, -1);
        for (let n = 0; n < coils; n++) {
          const foot = add(start, by(turn, ends + pitch * n));
          far += line(half(0.5, foot, pitch, turn));
          near += line(half(0, foot, pitch, turn));
        }
        put(back, "d", far);
        put(edge, "d", near);
        put(core, "d", near);
      };
    },

    damping(group, { between, reach, length, rod, colour, barrel, head }) {
      const cylinder = part(group, "g"), rods = stroked(group, colour, rod, { "stroke-linecap": "round" });
      const piston = part(group, "g");
      cylinder.innerHTML = barrel;
      piston.innerHTML = head;
      const foot = 0.6 * Math.max(0.5 * (reach[0] - length), 0);
      return (place) => {
        const start = place(between[0]), end = place(between[1]);
        const span = size(sub(end, start)), turn = unit(sub(end, start));
        const share = reach[1] > reach[0] ? clamp((span - reach[0]) / (reach[1] - reach[0]), 0, 1) : 0.5;
        const depth = foot + length * (0.16 + 0.68 * share);
        const along = (way) => add(start, by(turn, way));
        put(cylinder, "transform", matrix(turn, along(foot)));
        put(piston, "transform", matrix(turn, along(depth)));
        put(rods, "d", line([along(depth), along(Math.max(span, depth))]) + line([start, along(foot)]));
      };
    },

    curve(group, { at, width, colours }, tracks) {
      const { period } = tracks, count = Math.max(360, 360 * Math.round(period / TURN));
      const points = Array.from({ length: count }, (_, n) => tracks.get(at).at(n / count * period).p);
      stroked(group, colours[0], width, { d: line(points) + "Z" });
      return () => group.classList.toggle("off", !state.trace);
    },

    recent(group, { at, width, colours, phase, swell }, tracks) {
      const shades = colours.slice(1), pieces = 8;
      const wide = (n) => width * (1 + (swell - 1) * (n + 0.5) / shades.length);
      const paths = shades.map((colour, n) => stroked(group, colour, wide(n)));
      return () => {
        group.classList.toggle("off", !state.trace);
        if (!state.trace) return;
        const tail = Math.min(phase, tracks.period) * Math.sign(speed());
        paths.forEach((path, n) => put(path, "d", line(Array.from({ length: pieces + 1 }, (_, k) => {
          const age = 1 - (n + k / pieces) / shades.length;
          return tracks.get(at).at(state.phase - tail * age).p;
        }))));
      };
    },

    arrows(group, { order, at, gain, longest, line: thick, colours }) {
      const width = 1.6 * thick;
      const paths = at.map(() => part(group, "path", {
        fill: colours[0], stroke: colours[1], "stroke-width": 1.5 * thick, "paint-order": "stroke",
      }));
      return (place, pose) => {
        const shown = order === 1 ? state.velocity : state.acceleration;
        group.classList.toggle("off", !shown);
        if (!shown) return;
        at.forEach((name, n) => {
          const { p, v, a } = pose(name);
          const reach = order === 1 ? by(v, gain * Math.sign(speed())) : by(a, gain);
          const long = size(reach), seen = long > 0.01 * longest && long < 100 * longest;
          put(paths[n], "d", seen ? arrow(p, reach, width) : "");
        });
      };
    },

    turning(group, { pivot, pin, arc, arrow: radius, middle, sweep, ahead, angle, gain, line: thick, colours }) {
      const rim = stroked(group, colours[1], 3.5 * thick), bow = stroked(group, colours[0], 1.7 * thick);
      const tip = part(group, "path", { fill: colours[0], stroke: colours[1], "stroke-width": 1.5 * thick, "paint-order": "stroke" });
      const halo = stroked(group, colours[1], 2.6 * thick), round = stroked(group, colours[0], 0.9 * thick);
      const level = stroked(group, colours[0], 0.8 * thick, { "stroke-dasharray": `${2.2 * thick} ${1.3 * thick}` });
      const bent = (from, to) => Array.from({ length: 25 }, (_, n) => {
        const way = from + (to - from) * n / 24;
        return [Math.cos(way), Math.sin(way)];
      });
      return (place) => {
        const centre = place(pivot), way = unit(sub(place(pin), centre));
        const rate = gain * inputRate(), bend = -sweep * clamp(rate, -1, 1), side = Math.sign(bend);
        const drawn = Math.abs(bend) > 0.02;
        const points = bent(side * ahead, side * ahead + bend).map((to) => add(centre, by(mul(to, way), radius)));
        for (const path of [rim, bow]) put(path, "d", drawn ? line(points) : "");
        const last = points[24], on = mul(unit(sub(last, centre)), [0, side]);
        const head = Math.min(6.5 * thick, 0.8 * Math.abs(bend) * radius);
        const barb = [[0.75, 0], [-0.35, 0.5], [-0.35, -0.5]].map((to) => add(last, mul(on, by(to, head))));
        put(tip, "d", drawn ? line(barb) + "Z" : "");
        if (!angle) return;
        const turned = middle + mod(Math.atan2(-way[1], way[0]) - middle + Math.PI, TURN) - Math.PI;
        const path = line(bent(0, -turned).map((to) => add(centre, by(to, arc))));
        for (const each of [halo, round]) put(each, "d", path);
        put(level, "d", line([centre, add(centre, [1.45 * arc, 0])]));
      };
    },

    sliding(group, { at, along, room, longest, gain, line: thick, colours }) {
      const path = part(group, "path", {
        fill: colours[0], stroke: colours[1], "stroke-width": 1.8 * thick, "paint-order": "stroke",
      });
      return (place) => {
        const reach = by(along, longest * clamp(gain * inputRate(), -1, 1));
        const drawn = size(reach) > 0.02 * longest;
        put(path, "d", drawn ? arrow(add(place(at), by(unit(reach), room)), reach, 1.7 * thick) : "");
      };
    },
  };

  // Returns the outline of an arrow from its foot; short ones are smaller.
  function arrow(foot, reach, width) {
    const long = size(reach), head = Math.min(4.2 * width, 0.6 * long), half = Math.min(width / 2, head / 5);
    const neck = long - 0.9 * head, back = long - head, barb = 0.42 * head;
    const corners = [[0, -half], [neck, -half], [back, -barb], [long, 0], [back, barb], [neck, half], [0, half]];
    return line(corners.map((corner) => add(foot, mul(unit(reach), corner)))) + "Z";
  }

  // Returns how the input's coordinate, as it is read, changes by phase as it runs now: its table's slope.
  function inputRate() {
    const row = sides[state.side].rows[0], step = page.period / 480;
    const middle = clamp(mod(state.phase, page.period), step, page.period - step);
    const [before, after] = [middle - step, middle + step].map((phase) => reading(row.tables[0], row, shareOf(phase)));
    return (after - before) / (2 * step) * Math.sign(speed());
  }

  // --- both closures, ready to be moved -----------------------------------------------------------

  const sides = page.sides.map((data, number) => {
    // a map: an object has properties that nobody gave it, such as "constructor"
    const tracks = Object.assign(new Map(), { period: page.period });
    for (const name in data.tracks) tracks.set(name, new Track(data.tracks[name]));
    const group = byId(`side${number}`);
    const groups = [...group.querySelectorAll("[data-m]")];
    const laid = ({ ends, poles, ...rest }) => ({ ...rest, ends: ends && unpacked(ends, "f8"), poles: poles && unpacked(poles, "f8") });
    const rows = data.rows.map((row) => ({ ...laid(row), tables: (row.values || []).map((some) => unpacked(some, row.kind)) }));
    const charts = data.charts.map((chart) => ({
      ...chart, curves: chart.curves.map((curve) => ({ ...laid(curve), table: unpacked(curve.values, curve.kind) })),
    }));
    const moves = data.movers.map((mover, n) => KINDS[mover.kind](groups[n], mover, tracks));
    return { data, tracks, group, groups, rows, charts, moves };
  });
  const now = () => sides[state.side];
  const own = page.model && lengthsOf(page.model, {
    kinds: KINDS, part, put, say, unit, add, by, xy, line, view: page.sides[0].view, short, state, byId, wake: () => wake(),
  });
  // The tracks of what is shown: of the page's own linkage, or of other lengths.
  const tracksNow = () => own?.on ? own.tracks : now().tracks;
  const periodNow = () => tracksNow().period;

  // --- drawing ------------------------------------------------------------------------------------

  function draw() {
    const side = now(), poses = new Map();
    const pose = (name) => {
      if (!poses.has(name)) poses.set(name, tracksNow().get(name).at(state.phase));
      return poses.get(name);
    };
    const place = (name) => pose(name).p;
    sides.forEach(({ group }, n) => group.toggleAttribute("hidden", own?.on || n !== state.side));
    for (const move of own?.on ? own.moves : side.moves) move(place, pose);
    put(byId("grip"), "transform", `translate(${xy(place(side.data.drive))})`);
    drawRows(side);
    chart.classList.toggle("off", own?.on || !side.charts.length || !state.curves);
    if (side.charts.length && !own?.on) drawCursor(side.charts[state.way > 0 ? 0 : 1]);
    drawInput(side);
    if (byId("numbers").open) drawNumbers(side, pose);
    drawReading(side, pose);
  }

  function valueOf(row) {
    const back = state.way < 0, table = row.tables[back && !row.back ? 1 : 0];
    const held = (back && row.back || 1) * reading(table, row, shareOf(state.phase));
    const value = grown(held, row, state.phase);
    if (!row.turn) return value;
    const rounded = Number(mod(value, row.turn).toFixed(row.digits));
    return rounded >= row.turn ? 0 : rounded;
  }

  function words(value, digits, unitName) {
    if (!Number.isFinite(value)) return Number.isNaN(value) ? "–" : "∞";
    const text = value.toFixed(digits);
    return minus(Number(text) === 0 ? text.replace("-", "") : text) + (unitName === "°" ? "°" : ` ${unitName}`).trimEnd();
  }

  const OTHER = { label: page.input, text: null };
  const rowsNow = (side) => own?.on ? [OTHER] : side.rows;
  const rowWords = (row) => row === OTHER ? own.inputWords(state.phase) : row.text ? row.text[state.way > 0 ? 0 : 1] : words(valueOf(row), row.digits, row.unit);

  function drawRows(side) {
    const list = byId("rows");
    const key = own?.on ? "own" : String(state.side);
    if (list.dataset.side !== key) {
      list.dataset.side = key;
      list.replaceChildren(...rowsNow(side).flatMap((row) => {
        const name = document.createElement("dt"), value = document.createElement("dd");
        name.textContent = row.label;
        return [name, value];
      }));
    }
    rowsNow(side).forEach((row, n) => { say(list.children[2 * n + 1], rowWords(row)); });
  }

  let spoken = "";
  function drawInput(side) {
    const slider = byId("input"), text = rowWords(rowsNow(side)[0]);
    put(slider, "max", periodNow());
    slider.value = mod(state.phase, periodNow());
    slider.setAttribute("aria-valuetext", text);
    if (!state.playing && text !== spoken) byId("live").textContent = `${page.input} ${text}`;
    spoken = text;
  }

  // --- the chart ----------------------------------------------------------------------------------

  const chart = byId("chart");
  let cursor = null;

  function layChart() {
    const data = now().charts[state.way > 0 ? 0 : 1];
    chart.classList.toggle("off", !data);
    if (!data) return;
    chart.setAttribute("aria-label", data.title);
    chart.innerHTML = data.frame;
    const [left, top, width, high] = data.area, [low, up] = data.y;
    const level = (value) => top + high * (1 - clamp((value - low) / (up - low), 0, 1));
    const [origin, scale, span] = data.course;
    for (const curve of data.curves) {
      const { table, ends } = curve;
      let d = "";
      for (let part = 1; part < ends.length; part++) {
        const from = ends[part - 1], long = ends[part] - from, count = Math.ceil(long * width) + 1;
        for (let n = 0, pen = false; n <= count; n++) {
          // the end of a part, as a reading there is the beginning of the next
          const share = from + long * Math.min(n / count, 1 - 1e-9);
          const value = grown(reading(table, curve, share), curve, origin + scale * share * span), seen = Number.isFinite(value);
          if (seen) d += `${pen ? "L" : "M"}${xy([left + width * share, level(value)])}`;
          pen = seen;
        }
      }
      stroked(chart, curve.colour, data.width, { d });
    }
    const rule = stroked(chart, data.ink, 1.6);
    const dots = data.curves.map(({ colour }) => part(chart, "circle", { r: 5, fill: colour, stroke: "var(--back)", "stroke-width": 2 }));
    const label = part(chart, "text", { x: left + width, y: top - 0.5 * data.text, fill: data.ink, "text-anchor": "end", "font-size": 0.8 * data.text });
    cursor = { rule, dots, label, level };
  }

  // Returns how far along a chart the cursor stands, 0 to 1; one over time begins with the period, or ends with it.
  function chartShare({ course: [origin, scale, span] }) {
    const along = mod((state.phase - origin) / scale, span) / span;
    if (!page.retraced) return along;
    return scale > 0 ? shareOf(state.phase) : 1 - shareOf(state.phase);
  }

  function drawCursor(data) {
    const [left, top, width, high] = data.area, share = chartShare(data), x = left + width * share;
    put(cursor.rule, "d", `M${x.toFixed(2)} ${top}V${top + high}`);
    say(cursor.label, data.curves.map((curve, n) => {
      const { table, label } = curve, value = grown(reading(table, curve, share), curve, state.phase), dot = cursor.dots[n];
      dot.setAttribute("cx", x);
      dot.setAttribute("cy", Number.isFinite(value) ? cursor.level(value) : -100);
      return `${label} ${words(value, data.digits, data.unit)}`.trim();
    }).join("   "));
  }

  function scrub(event) {
    const data = now().charts[state.way > 0 ? 0 : 1], [left, , width] = data.area, [origin, scale, span] = data.course;
    const share = clamp((under(chart, event)[0] - left) / width, 0, 1);
    pause();
    moveTo(origin + scale * share * span);
  }

  // --- numbers at the pointer, and all of them ----------------------------------------------------

  function under(svg, event) {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    return [at.x, at.y];
  }

  const clear = (x) => Math.abs(x) < 1e-5 ? 0 : x;
  const world = ([x, y], [scale, left, top]) => [clear(x - left) / scale, clear(top - y) / scale];
  const couple = (a) => `(${short(a[0])}, ${short(a[1])})`;
  // rates have four digits of the larger one
  const rates = (a) => {
    const large = Math.max(...a.map(Math.abs)), step = large > 0 ? 10 ** (Math.floor(Math.log10(large)) - 3) : 1;
    return couple(a.map((one) => Math.round(one / step) * step));
  };

  function inUnits({ p, v, a }, view) {
    const rate = speed() / view[0];
    return {
      place: world(p, view), velocity: [clear(v[0]) * rate, clear(-v[1]) * rate],
      acceleration: [clear(a[0]) * rate * speed(), clear(-a[1]) * rate * speed()],
    };
  }

  function drawReading(side, pose) {
    const { pointer } = state, view = side.data.view;
    let text = "";
    if (pointer) {
      const reach = 14 / (byId("picture").getScreenCTM()?.a || 1);
      const apart = (name) => size(sub(pose(name).p, pointer.at));
      const near = side.data.joints.filter((name) => tracksNow().has(name) && apart(name) < reach).sort((one, other) => apart(one) - apart(other))[0];
      if (near) {
        const { place, velocity, acceleration } = inUnits(pose(near), view);
        text = `${near} ${couple(place)} ${page.unit}\nv = ${short(size(velocity))} ${page.unit}/s   ` +
          `a = ${short(size(acceleration))} ${page.unit}/s²`;
      } else {
        text = `${couple(world(pointer.at, view))} ${page.unit}`;
        const { link, tail, head } = pointer.mover || {};
        if (link) {
          const [way, moved] = ["p", "v"].map((kind) => sub(pose(head)[kind], pose(tail)[kind]).map(clear));
          const turning = -(way[0] * moved[1] - way[1] * moved[0]) / (size(way) ** 2) * speed();
          const angle = mod(Math.atan2(-way[1], way[0]) * 180 / Math.PI, 360).toPrecision(4);
          text = `${link}: ω = ${short(turning)} rad/s\n` +
            `${short(size(way) / view[0])} ${page.unit} at ${short(mod(Number(angle), 360))}°`;
        }
      }
    }
    say(byId("reading"), text);
  }

  function drawNumbers(side, pose) {
    const row = (cell, texts) => {
      const made = document.createElement("tr");
      texts.forEach((text, n) => {
        const one = made.appendChild(document.createElement(n ? cell : "th"));
        one.textContent = text;
        if (cell === "th" || !n) one.scope = cell === "th" ? "col" : "row";
      });
      return made;
    };
    const { unit: of } = page, [head, body] = byId("numbers").querySelectorAll("thead, tbody");
    head.replaceChildren(row("th", ["point", `position (${of})`, `velocity (${of}/s)`, `acceleration (${of}/s²)`]));
    body.replaceChildren(...[...tracksNow().keys()].map((name) => {
      const { place, velocity, acceleration } = inUnits(pose(name), side.data.view);
      return row("td", [name, couple(place), rates(velocity), rates(acceleration)]);
    }));
  }

  // --- time, hand and keys ------------------------------------------------------------------------

  let waiting = false, before = 0;
  function wake() {
    if (!waiting) requestAnimationFrame(frame);
    waiting = true;
  }
  function frame(time) {
    waiting = false;
    if (state.playing) {
      const seconds = before ? clamp((time - before) / 1000, 0, 0.1) : 0;
      state.phase = mod(state.phase + speed() * state.pace * seconds, periodNow());
      state.last = Math.sign(speed());
      wake();
    }
    before = state.playing ? time : 0;
    draw();
  }

  function moveTo(phase) {
    const period = periodNow(), step = mod(phase - state.phase + period / 2, period) - period / 2;
    if (step) state.last = Math.sign(step);
    state.phase = mod(phase, period);
    wake();
  }
  const pause = () => play(false);
  function play(on) {
    state.playing = on;
    byId("play").textContent = on ? "Pause" : "Play";
    wake();
  }
  function step(times) {
    pause();
    moveTo(state.phase + times * STEP * Math.sign(page.speed));
  }

  // Moves the input to where its joint comes nearest to the pointer within a quarter turn: of several such
  // places to the next one, at the end of a swing, where two are alike, on in the same way.
  function drag(target) {
    const track = tracksNow().get(now().data.drive), step = TURN / 360;
    const off = (phase) => { const gap = sub(track.at(phase).p, target); return gap[0] ** 2 + gap[1] ** 2; };
    const tried = Array.from({ length: 183 }, (_, n) => state.phase + (n - 91) * step), offs = tried.map(off);
    const near = tried.filter((_, n) => n && n < 182 && offs[n] <= offs[n - 1] && offs[n] <= offs[n + 1])
      .map((phase) => lowest(off, phase - step, phase + step));
    const least = Math.min(...near.map(off));
    const way = (phase) => Math.abs(phase - state.phase) * (Math.sign(phase - state.phase) === state.last ? 1 : 1.5);
    const best = near.filter((phase) => off(phase) <= 1.001 * least + 1).sort((one, other) => way(one) - way(other))[0];
    if (best !== undefined) moveTo(best);
  }
  function lowest(of, low, high) {
    for (let n = 0; n < 30; n++) {
      const one = low + (high - low) / 3, other = high - (high - low) / 3;
      if (of(one) < of(other)) high = other; else low = one;
    }
    return (low + high) / 2;
  }

  const picture = byId("picture"), handle = byId("handle");
  handle.addEventListener("pointerdown", (event) => {
    if (event.button) return;
    event.preventDefault();
    handle.setPointerCapture(event.pointerId);
    pause();
    state.held = sub(under(picture, event), tracksNow().get(now().data.drive).at(state.phase).p);
    picture.classList.add("held");
  });
  handle.addEventListener("touchstart", (event) => event.preventDefault(), { passive: false });  // no scrolling
  handle.addEventListener("pointermove", (event) => {
    if (state.held) drag(sub(under(picture, event), state.held));
  });
  for (const end of ["pointerup", "pointercancel"]) handle.addEventListener(end, () => {
    state.held = null;
    picture.classList.remove("held");
  });
  for (const kind of ["pointermove", "pointerdown"]) picture.addEventListener(kind, (event) => {
    const group = event.target.closest("[data-m]");
    state.pointer = { at: under(picture, event), mover: group && now().data.movers[group.dataset.m] };
    wake();
  });
  picture.addEventListener("pointerleave", () => { state.pointer = null; wake(); });
  chart.addEventListener("pointerdown", (event) => { chart.setPointerCapture(event.pointerId); scrub(event); });
  chart.addEventListener("pointermove", (event) => { if (event.buttons) scrub(event); });

  function toggle(name, on = !state[name]) {
    state[name] = on;
    byId(name).setAttribute("aria-pressed", on);
    byId("rows").classList.toggle("off", !state.values);
    wake();
  }
  function showSide(number) {
    state.side = mod(number, sides.length);
    own?.renew();
    const { name } = now().data, button = byId("closure");
    button.textContent = name ? `Closure: ${name}` : "Closure";
    button.classList.toggle("off", sides.length < 2);
    layChart();
    wake();
  }
  function reverse() {
    state.way = -state.way;
    byId("reverse").setAttribute("aria-pressed", state.way < 0);
    layChart();
    wake();
  }
  function pace(steps) {
    const list = byId("pace");
    list.selectedIndex = clamp(list.selectedIndex + steps, 0, list.options.length - 1);
    state.pace = Number(list.value);
  }
  function theme() {
    if (page.theme) return;
    const root = document.documentElement;
    const dark = root.dataset.theme ? root.dataset.theme === "dark" : matchMedia("(prefers-color-scheme: dark)").matches;
    root.dataset.theme = dark ? "light" : "dark";
  }

  const ACTIONS = {
    play: () => play(!state.playing), back: () => step(-1), forth: () => step(1), reverse,
    closure: () => showSide(state.side + 1), theme,
  };
  for (const name of ["trace", "velocity", "acceleration", "names", "values", "curves"]) ACTIONS[name] = () => toggle(name);
  for (const name in ACTIONS) byId(name).addEventListener("click", ACTIONS[name]);
  byId("pace").addEventListener("change", () => pace(0));
  byId("input").addEventListener("input", (event) => { pause(); moveTo(Number(event.target.value)); });
  byId("numbers").addEventListener("toggle", wake);

  const KEYS = {
    " ": ACTIONS.play, d: reverse, b: ACTIONS.closure, t: ACTIONS.trace, v: ACTIONS.velocity, a: ACTIONS.acceleration,
    n: ACTIONS.names, l: theme, r: () => moveTo(0), arrowup: () => pace(1), arrowdown: () => pace(-1),
  };
  document.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("select, #lengths input")) return;
    const key = event.key.toLowerCase(), on = event.target.closest("button, summary");
    if (key === "arrowleft" || key === "arrowright") step((key === "arrowright" ? 1 : -1) * (event.shiftKey ? 10 : 1));
    else if (KEYS[key] && !(key === " " && on)) KEYS[key]();
    else return;
    event.preventDefault();
  });

  // --- the start ----------------------------------------------------------------------------------

  const hide = (name, when) => byId(name).classList.toggle("off", when);
  hide("names", !sides[0].data.movers.some(({ kind }) => kind === "label"));
  hide("trace", !sides[0].data.movers.some(({ kind }) => kind === "curve"));
  for (const [name, order] of [["velocity", 1], ["acceleration", 2]])
    hide(name, !sides[0].data.movers.some((mover) => mover.kind === "arrows" && mover.order === order && mover.at.length));
  hide("theme", Boolean(page.theme));
  hide("curves", !sides.some(({ charts }) => charts.length));
  for (const name of ["values", "curves"]) toggle(name, state[name]);
  hide("lengths", !own);
  if (own) globalThis.lengths = own;
  const slider = byId("input");
  slider.min = 0;
  slider.setAttribute("aria-label", page.input);
  byId("grip").classList.remove("off");
  showSide(0);
  play(state.playing);
})();
