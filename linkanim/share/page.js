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

  // a sentence in the page's language, with its parts in their places
  const said = (text, parts = {}) => (Object.hasOwn(page.said, text) ? page.said[text] : text).replace(/\{(\w+)\}/g, (_, name) => parts[name]);
  const minus = (text) => text.replaceAll("-", "−");
  const short = (x) => minus(String(Number(x.toPrecision(4))));

  const NUMBERS = { u1: Uint8Array, u2: Uint16Array, i2: Int16Array, i4: Int32Array, f4: Float32Array, f8: Float64Array };
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

  // the least size of names and the longest arrow of the key on the screen, in its pixels; the poses of a period that
  // are looked at
  const LEAST = 12, KEY = 54, POSES = 180;
  const picture = byId("picture"), about = byId("about").textContent, whole = picture.getAttribute("viewBox");
  let zoom = 1;
  const motionIsFine = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  const state = {
    phase: 0, playing: motionIsFine, pace: 1, way: 1, side: 0, last: 1,
    trace: true, velocity: false, acceleration: false, force: false, names: true, pointer: null, held: null,
    values: false, curves: false,
  };
  const speed = () => page.speed * state.way;

  // --- lights: what is pointed at or focused lights its part of the picture, and a part all that is said of it -----
  //
  // A key is of a joint, "j B", its velocity, "v B", or acceleration, "a B", of a force, "f F_{A,3}", a link, "l 3", the
  // ground's line, "g", or a spring or damper, by the joints at its ends, "s C G".

  const lit = new Set();
  const keyOf = ({ order, at, symbols }, n) => order ? `${" va"[order]} ${at[n]}` : `f ${symbols[n]}`;
  const keysIn = (node) => JSON.parse(node.dataset.y);
  function mark(node, keys, reached) {
    if (!keys.length) return node;
    node.dataset.y = JSON.stringify(keys);
    if (reached) node.tabIndex = 0;
    return node;
  }
  function relight() {
    for (const node of document.querySelectorAll("[data-y]")) node.classList.toggle("lit", keysIn(node).some((key) => lit.has(key)));
  }
  function light(event) {
    const node = [event.type === "focusout" ? null : event.target, document.activeElement].map((one) => one?.closest?.("[data-y]")).find(Boolean);
    const keys = node ? keysIn(node) : [];
    if (keys.length === lit.size && keys.every((key) => lit.has(key))) return;
    lit.clear();
    keys.forEach((key) => lit.add(key));
    relight();
    wake();
  }
  for (const kind of ["pointerover", "pointerdown", "focusin", "focusout"]) document.addEventListener(kind, light);

  // Returns the keys of what is between joints: of the link that reaches to all of them, or the ground's line; else their own.
  function keysAlong(names) {
    if (names.length < 2) return names.map((name) => `j ${name}`);
    const has = ({ tail, head, reaches = [], names: level = [] }) => names.every((name) => [tail, head, ...reaches, ...level].includes(name));
    const [found] = now().data.movers.filter((mover) => (mover.link || mover.kind === "level") && has(mover));
    return !found ? names.map((name) => `j ${name}`) : found.link ? [`l ${found.link}`] : ["g"];
  }

  // Returns the keys of a group of the picture.
  function keysOf(mover, group) {
    const { kind, at, tail, head, link, between } = mover;
    if (kind === "coil" || kind === "damping") return [`s ${between.join(" ")}`];
    if (kind === "level") return ["g"];
    if (kind === "part" && tail === head && !mover.named) return link ? [`l ${link}`, `j ${at}`] : [`j ${at}`];
    if (link) return [`l ${link}`];
    const [of, name] = kind === "label" ? (group.querySelector("text")?.dataset.of || "").split(/:(.*)/s) : [];
    if (of === "joint") return [`j ${name}`];
    if (of === "body") return [`l ${page.links[name] || name}`];
    return of === "dimension" || mover.named ? keysAlong([at || tail, head]) : [];
  }

  // --- what moves: each kind gets its group, and gives what puts it at a pose ---------------------
  //
  // Where lengths are changed it is told the poses `before` and `after`, and works out what follows from lengths.

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

  // How far a label of these sides is pushed along a way, so that it just clears what lies at its begin.
  function pushed(way, reach, [wide, high], flat) {
    const [x, y] = way.map(Math.abs), w = wide / 2, h = high / 2;
    if (!x && !y) return [0, 0];
    if (flat) return by(way, reach + x * w + y * h);
    if (x && (w + reach) * y <= h * x) return by(way, (w + reach) / x);
    if (y && (h + reach) * x <= w * y) return by(way, (h + reach) / y);
    return by(way, x * w + y * h + Math.sqrt(Math.max(reach ** 2 - (x * h - y * w) ** 2, 0)));
  }

  // By how much a label is larger than it is drawn, and where its middle stands.
  const grownOf = ({ font }) => Math.max(1, LEAST / (font * zoom));
  function labelled(mover, place) {
    const { at, head, base, way, reach, flat, turns, size: sides } = mover;
    const span = at === head ? [now().data.view[0], 0] : sub(place(head), place(at)), turned = turns && at !== head ? mul(way, unit(span)) : way;
    return add(add(place(at), mul(base, span)), pushed(turned, reach, by(sides, grownOf(mover)), flat));
  }

  // By how much what is between two joints has grown.
  const grownWheel = ([one, other], { before, after }) => {
    const [old, fresh] = [before, after].map(([of]) => size(sub(of.get(other), of.get(one))));
    return fresh / old;
  };

  // Returns places on a track from one phase to another, closer where it bends: no chord of it may be seen.
  function pathOf(track, from, to, pieces) {
    const place = (n) => track.at(from + (to - from) * n / pieces).p;
    const bent = (begin, end, first, last, times) => {
      const half = (begin + end) / 2, middle = place(half);
      if (!times || size(sub(middle, by(add(first, last), 0.5))) < 0.1) return [first];
      return [...bent(begin, half, first, middle, times - 1), ...bent(half, end, middle, last, times - 1)];
    };
    return [...Array.from({ length: pieces }, (_, n) => bent(n, n + 1, place(n), place(n + 1), 6)).flat(), place(pieces)];
  }

  const KINDS = {
    part(group, mover, tracks, changed) {
      const { at, tail, head, named, given, sized, forms } = mover, still = tail === head;
      const grown = changed && sized ? grownWheel(sized, changed) : 1;
      if (changed && forms) reshape([...group.querySelectorAll("path")], mover, changed);
      return (place) => {
        group.classList.toggle("off", Boolean(given && changed || named && !state.names));
        const turn = still ? [1, 0] : unit(sub(place(head), place(tail)));
        put(group, "transform", matrix(by(turn, grown), place(at)));
      };
    },

    // what holds for the lengths alone that the page has
    given(group, mover, tracks, changed) {
      return () => group.classList.toggle("off", Boolean(changed));
    },

    label(group, mover, tracks, changed) {
      return (place) => {
        put(group, "transform", matrix([grownOf(mover), 0], labelled(mover, place)));
        group.classList.toggle("off", !state.names || Boolean(mover.given && changed));
      };
    },

    // the line of the ground, in dashes and dots
    level(group, { names, line: thick, colour }, tracks) {
      const dashes = [5, 1.8, 0.9, 1.3].map((share) => share * thick).join(" ");
      stroked(group, colour, 0.8 * thick, { d: line(names.map((name) => tracks.get(name).at(0).p)), "stroke-dasharray": dashes });
      return () => {};
    },

    rails(group, { at, along, beyond, aside, closed, bar, line: thick, colour }, tracks, changed) {
      if (changed) {
        const way = changed.after.map((of) => mul(of.get(at), back(along)));
        const [low, high] = ends(way.map(([x]) => x)), begin = low - beyond[0], end = high + beyond[1], across = way[0][1];
        const sides = [1, -1].map((side) => [[begin, across + side * aside], [end, across + side * aside], side]);
        if (closed) sides.push([[end, across + aside], [end, across - aside], 1]);
        const drawn = (lines) => lines.map((points) => line(points.map((point) => mul(along, point)))).join("");
        const strokes = sides.flatMap(([from, to, side]) => {
          const long = size(sub(to, from)), count = Math.max(Math.round(long / (0.62 * bar)), 1), ahead = unit(sub(to, from));
          return Array.from({ length: count }, (_, n) => {
            const foot = add(from, by(ahead, long * (n + 0.75) / count));
            return [foot, add(foot, mul(ahead, [-0.5 * bar, 0.62 * side * bar]))];
          });
        });
        group.replaceChildren();
        stroked(group, colour, 1.4 * thick, { d: drawn(sides.map((side) => side.slice(0, 2))) });
        stroked(group, colour, 0.8 * thick, { d: drawn(strokes) });
      }
      return () => {};
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

    damping(group, { between, reach: given, length, rod, colour, barrel, head }, tracks, changed) {
      const reach = changed ? ends(changed.after.map((of) => size(sub(of.get(between[1]), of.get(between[0]))))) : given;
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
      const points = pathOf(tracks.get(at), 0, tracks.period, 180 * Math.max(1, Math.round(tracks.period / TURN)));
      stroked(group, colours[0], width, { d: line(points) });
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
        paths.forEach((path, n) => {
          const [from, to] = [n, n + 1].map((shade) => state.phase - tail * (1 - shade / shades.length));
          put(path, "d", line(pathOf(tracks.get(at), from, to, pieces)));
        });
      };
    },

    arrows(group, mover) {
      const { at, line: thick, colours, usual } = mover, width = 1.6 * thick;
      const paths = at.map(() => part(group, "path", {
        fill: colours[0], stroke: colours[1], "stroke-width": 1.5 * thick, "paint-order": "stroke",
      }));
      const keys = at.map((_, n) => keyOf(mover, n));
      paths.forEach((path, n) => mark(path, [keys[n]]));
      return (place, pose) => {
        const { shown, known, of } = arrowsOf(mover), seen = keys.map((key, n) => shown && n < usual || known && lit.has(key));
        group.classList.toggle("off", !seen.includes(true));
        paths.forEach((path, n) => {
          if (!seen[n]) return put(path, "d", "");
          const { p, reach, seen: drawn } = of(n, pose, state.phase);
          put(path, "d", drawn ? arrow(p, reach, width) : "");
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

  // Returns whether arrows of a kind are shown and are known, and what gives the place and reach of one of them in a pose. Forces
  // are known for the page's own lengths alone.
  const ARROWS = ["force", "velocity", "acceleration"];
  function arrowsOf(mover) {
    const { at, order, gain, longest, drawn } = mover, known = order > 0 || !own?.on, shown = state[ARROWS[order]] && known;
    const of = (n, pose, phase) => {
      const foot = order ? pose(at[n]) : { p: footOf(at[n], pose) };
      const reach = order === 0 ? by(back(pulled(mover, n, phase)), mover.per) : by(order === 1 ? foot.v : foot.a, gain * (order === 1 ? Math.sign(speed()) : 1));
      const long = size(reach);
      return { p: foot.p, reach, seen: long > 0.01 * longest && long < drawn };
    };
    return { shown, known, of };
  }

  // Returns where a force acts: in a joint, or at a place of a body that two of its joints tell.
  function footOf(at, pose) {
    if (typeof at === "string") return pose(at).p;
    const [one, other, share] = at, here = pose(one).p;
    return add(here, one === other ? share : mul(share, sub(pose(other).p, here)));
  }

  // Returns a force at a phase in newtons, y up, as its table has it.
  function pulled(mover, n, phase) {
    const { grain, tables } = mover, table = tables[state.way < 0 ? tables.length - 1 : 0], count = table.length / grain.length / 2;
    return [0, 1].map((axis) => {
      const begin = (2 * n + axis) * count;
      return grown(grain[n] * reading(table.subarray(begin, begin + count), mover, shareOf(phase)), mover, phase);
    });
  }

  // Lays out the key to the arrows that are shown: one of each kind, and how much it stands for.
  function layKey() {
    byId("key").replaceChildren();
    const side = now();
    if (state.force && own?.on) byId("key").appendChild(document.createElement("em")).textContent = said("Forces are known for the page’s own lengths alone.");
    for (const mover of side.data.movers.filter((one) => one.kind === "arrows" && arrowsOf(one).shown)) {
      const { order, gain, line: thick, colours, words: named, unit: of } = mover;
      const scale = order ? gain * side.data.view[0] / Math.abs(speed()) ** order : mover.per, most = KEY / (zoom * scale);
      const power = 10 ** Math.floor(Math.log10(most)), value = power * [5, 2, 1].find((one) => one * power <= most * 1.0001);
      const long = value * scale, sample = byId("key").appendChild(document.createElementNS(SVG, "svg"));
      sample.setAttribute("viewBox", `0 ${-5 * thick} ${long} ${10 * thick}`);
      sample.style.width = `${long * zoom}px`;
      part(sample, "path", { fill: colours[0], d: arrow([0, 0], [long, 0], 1.6 * thick) });
      for (const [kind, text] of [["span", named], ["b", `${short(value)} ${of}`]]) byId("key").appendChild(document.createElement(kind)).textContent = text;
    }
  }

  // Returns the outline of an arrow from its foot; short ones are smaller.
  function arrow(foot, reach, width) {
    const long = size(reach), head = Math.min(4.2 * width, 0.6 * long), half = Math.min(width / 2, head / 5);
    const neck = long - 0.9 * head, back = long - head, barb = 0.42 * head;
    const corners = [[0, -half], [neck, -half], [back, -barb], [long, 0], [back, barb], [neck, half], [0, half]];
    return line(corners.map((corner) => add(foot, mul(unit(reach), corner)))) + "Z";
  }

  // Returns how the input's coordinate, as it is read, changes by phase as it runs now: its table's slope.
  function inputRate() {
    if (own?.on) return own.inputAt(state.phase)[1] * 180 / Math.PI * Math.sign(speed());
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
    for (const use of group.querySelectorAll("use")) {
      use.replaceWith(...document.querySelector(use.getAttribute("href")).cloneNode(true).childNodes);
    }
    const groups = [...group.querySelectorAll("[data-m]")], marked = groups.map((one) => one.innerHTML);
    const laid = ({ ends, poles, ...rest }) => ({ ...rest, ends: ends && unpacked(ends, "f8"), poles: poles && unpacked(poles, "f8") });
    const rows = data.rows.map((row) => ({ ...laid(row), tables: (row.values || []).map((some) => unpacked(some, row.kind)) }));
    const charts = data.charts.map((chart) => ({
      ...chart, curves: chart.curves.map((curve) => ({ ...laid(curve), table: unpacked(curve.values, curve.kind) })),
    }));
    for (const mover of data.movers.filter(({ values }) => values)) {
      Object.assign(mover, laid(mover), { tables: mover.values.map((some) => Float64Array.from(unpacked(some, "i2"), (step) => step < -32767 ? NaN : step)) });
    }
    return { data, tracks, group, groups, marked, rows, charts, moves: [] };
  });
  const now = () => sides[state.side];
  const lengthRows = () => own ? own.rows : [];
  const own = page.model && lengthsOf(page.model, {
    view: page.sides[0].view, say, said, short, state, byId, renewed: () => lay(),
  });
  // The tracks of what is shown: of the page's own linkage, or of other lengths.
  const tracksNow = () => own?.on ? own.tracks : now().tracks;
  const periodNow = () => tracksNow().period;

  // --- drawing ------------------------------------------------------------------------------------

  const turnsOf = (tracks) => clamp(Math.round(tracks.period / TURN), 1, 8);
  function posesOf(tracks) {
    const count = POSES * turnsOf(tracks);
    return Array.from({ length: count }, (_, n) => new Map([...tracks].map(([name, track]) => [name, track.at(n / count * tracks.period).p])));
  }

  // Draws the groups of what is shown: as they are given, or as they are with other lengths.
  function lay() {
    const side = now(), tracks = tracksNow(), [wide, high] = whole.split(" ").slice(2).map(Number);
    sides.forEach(({ group }, n) => group.toggleAttribute("hidden", n !== state.side));
    side.before ||= posesOf(side.tracks);
    const changed = own?.on ? { before: side.before, after: posesOf(tracks) } : null;
    side.moves = side.data.movers.map((mover, n) => {
      side.groups[n].innerHTML = side.marked[n];
      mark(side.groups[n], keysOf(mover, side.groups[n]));
      return KINDS[mover.kind](side.groups[n], mover, tracks, changed);
    });
    // the dimensions that have no place in the picture: r₂ = 55 mm, O₂–A
    for (const text of side.group.querySelectorAll("[data-of=legend]")) {
      const names = text.textContent.split(", ").at(-1).split("–");
      mark(text, names.length === 2 && names.every((name) => tracks.has(name)) ? keysAlong(names) : []);
    }
    const inPicture = new Set([...side.group.querySelectorAll("[data-y]")].flatMap(keysIn)), drawn = (keys) => keys.filter((key) => inPicture.has(key));
    mark(chart, drawn(side.charts[0]?.of || []));
    lengthRows().forEach(([box, names]) => mark(box, drawn(keysAlong(names))));
    layNumbers(side, drawn);
    relight();
    side.box = [[0, wide], [0, high]];
    side.poses = changed ? changed.after : side.before;
    byId("about").classList.toggle("changed", Boolean(changed));
    byId("about").textContent = changed ? said("With other lengths: {found}", { found: own.told() }) : about;
    side.beyond = changed ? changed.after.flatMap((of) => [...of.values()]) : [];
    if (changed) side.data.movers.forEach((mover, n) => { side.beyond.push(...wheeled(mover, side.groups[n], changed)); });
    chart.classList.toggle("off", !side.charts.length || !state.curves);
    compose();
  }

  function compose() {
    layKey();
    arrange();
    layKey();  // its arrows are as long as those of the picture
    layChart();
  }

  // Returns the corners of the squares that a wheel takes up.
  function wheeled({ at, sized }, group, changed) {
    if (!sized) return [];
    const { x, y, width, height } = group.getBBox(), far = Math.max(-x, -y, x + width, y + height) * grownWheel(sized, changed);
    return changed.after.flatMap((of) => [-far, far].map((off) => add(of.get(at), [off, off])));
  }

  // Puts all of a period into the view, with names and the arrows that are shown, and the chart where it leaves the
  // picture larger: beside it or below.
  function arrange() {
    const side = now(), margin = 0.04 * side.box[0][1], phases = Array.from({ length: 60 }, (_, n) => n / 60 * periodNow());
    const shown = side.data.movers.filter((mover) => mover.kind === "arrows" && arrowsOf(mover).shown);
    const heads = shown.flatMap((mover) => mover.at.slice(0, mover.usual).flatMap((_, n) => phases.map((phase) => {
      // beside a dead centre arrows are longer than any picture
      const { p, reach } = arrowsOf(mover).of(n, (name) => tracksNow().get(name).at(phase), phase);
      return add(p, by(reach, Math.min(1, 1.5 * mover.longest / size(reach) || 0)));
    })));
    const points = [...side.beyond, ...heads].filter((point) => point.every(Number.isFinite)), labels = side.data.movers.filter(({ kind, given }) => kind === "label" && !(given && own?.on));
    const panes = byId("panes"), room = panes.clientWidth - byId("told").offsetWidth, { clientHeight: tall } = panes;
    for (let times = 0; times < 3; times++) {  // names are the larger the smaller the picture becomes
      const names = labels.flatMap((mover) => side.poses.flatMap((of, n) => {
        // letters may be a little wider in the reader's font
        const half = mul([0.5 * grownOf(mover), 0], [1.15 * mover.size[0], 1.3 * mover.size[1]]), middle = n % 3 ? null : labelled(mover, (name) => of.get(name));
        return middle ? [sub(middle, half), add(middle, half)] : [];
      }));
      const [[left, right], [top, low]] = side.box.map((box, n) =>
        ends([...box, ...points.flatMap((point) => [point[n] - margin, point[n] + margin]), ...names.map((point) => point[n])]));
      const wide = right - left, high = low - top;
      put(picture, "viewBox", `${left} ${top} ${wide} ${high}`);
      const beside = Math.min(0.6 * room / wide, tall / high), below = Math.min(room / wide, (tall - 0.31 * innerHeight) / high);
      panes.classList.toggle("beside", beside > below && !chart.classList.contains("off"));
      zoom = picture.getScreenCTM()?.a || 1;
    }
    wake();
  }

  function draw() {
    const side = now(), poses = new Map();
    const pose = (name) => {
      if (!poses.has(name)) poses.set(name, tracksNow().get(name).at(state.phase));
      return poses.get(name);
    };
    const place = (name) => pose(name).p;
    zoom = picture.getScreenCTM()?.a || 1;
    for (const move of side.moves) move(place, pose);
    put(byId("grip"), "transform", `translate(${xy(place(side.data.drive))})`);
    drawRows(side);
    drawCursor();
    drawInput(side);
    if (byId("numbers").open) drawNumbers(pose);
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

  // the rows that hold for the lengths that are shown: where they are changed, those that follow from the joints
  const rowsNow = (side) => own?.on ? side.rows.filter((row, n) => n < 2 || row.law) : side.rows;
  function rowWords(row, n) {
    if (own?.on && n < 2) return n ? own.speedWords(speed(), row.text[state.way > 0 ? 0 : 1]) : own.inputWords(state.phase);
    return row.text ? row.text[state.way > 0 ? 0 : 1] : words(own?.on ? follows(row.law, state.phase) : valueOf(row), row.digits, row.unit);
  }

  // Returns what a law gives at a phase, from the joints as they are with the lengths that are shown.
  function follows({ of, at, order, axis, way, gain, shift }, phase) {
    const rate = speed() / now().data.view[0];
    const [first, second] = at.map((name) => {
      const { p, v, a } = tracksNow().get(name).at(phase);
      return [world(p, now().data.view), by(back(v), rate), by(back(a), rate * speed())];
    });
    const dot = (a, b) => a[0] * b[0] + a[1] * b[1];
    if (of === "point") return gain * (axis === null ? size(first[order]) : first[order][axis]) + shift;
    const [p, v, a] = first.map((one, n) => sub(second[n], one)), cross = (b) => p[0] * b[1] - p[1] * b[0];
    const found = {
      travel: () => dot([p, v, a][order], way),
      span: () => order ? dot(p, v) / size(p) : size(p),
      turn: () => [Math.atan2(p[1], p[0]), cross(v) / dot(p, p), cross(a) / dot(p, p)][order],
    }[of]();
    return gain * found + shift;
  }

  function drawRows(side) {
    const list = byId("rows");
    const key = own?.on ? "own" : String(state.side);
    if (list.dataset.side !== key) {
      list.dataset.side = key;
      list.replaceChildren(...rowsNow(side).flatMap((row) => {
        const name = document.createElement("dt"), value = document.createElement("dd");
        name.textContent = row.label;
        mark(name, row.of || [], true);
        return [name, mark(value, row.of || [])];
      }));
    }
    rowsNow(side).forEach((row, n) => { say(list.children[2 * n + 1], rowWords(row, n)); });
  }

  let spoken = "";
  function drawInput(side) {
    const slider = byId("input"), text = rowWords(rowsNow(side)[0], 0);
    put(slider, "max", periodNow());
    slider.value = mod(state.phase, periodNow());
    slider.setAttribute("aria-valuetext", text);
    if (!state.playing && text !== spoken) byId("live").textContent = `${page.input} ${text}`;
    spoken = text;
  }

  // --- the chart ----------------------------------------------------------------------------------

  const chart = byId("chart");
  let cursor = null;

  // Returns ticks from low to high, at most so many where that can be had: at round numbers, angles at parts of a turn.
  function ticksOf(low, high, most, sign) {
    const span = high - low, power = 10 ** Math.floor(Math.log10(span / most));
    const parts = sign && span / most > 7.5 ? [15, 30, 45, 90, 180, 360, 720] : [1, 2, 5, 10].map((one) => one * power);
    const step = parts.find((one) => span / one <= most * (1 + 1e-9)) || parts.at(-1), digits = Math.max(-Math.floor(Math.log10(step) + 1e-9), 0);
    const first = Math.ceil(low / step - 1e-9), last = Math.floor(high / step + 1e-9);
    return Array.from({ length: last - first + 1 }, (_, n) => [(first + n) * step, minus(((first + n) * step).toFixed(digits).replace(/^-(0\.?0*)$/, "$1")) + sign]);
  }

  // Returns the chart of what is shown: its course, and of each curve its runs of [share, value] and what it reads;
  // null where the quantity does not follow from the joints alone.
  function charted() {
    const [forth, other] = now().charts;
    if (!forth) return null;
    const data = state.way > 0 ? forth : { ...forth, ...other };
    if (!own?.on) return { ...data, title: data.titles[2], curves: data.curves.map((curve) => ({ ...curve, ...given(data, curve) })) };
    if (!data.curves.every(({ law }) => law)) return { ...data, curves: [], unknown: true };
    const swings = own.range && data.across, timed = own.range || !data.across;
    const course = timed ? [0, speed(), periodNow() / Math.abs(speed())] : data.course;
    const shown = { ...data, course, across: swings ? "" : data.across, title: data.titles[swings ? 3 : 2], marks: [] };
    shown.curves = data.curves.map((curve) => {
      const [origin, scale, span] = course, run = [], count = 360 * turnsOf(own.tracks);
      for (let n = 0; n <= count; n++) {
        const value = follows(curve.law, origin + scale * n / count * span), before = n && data.unit === "°" ? run.at(-1)[1] : value;
        run.push([n / count, value + 360 * Math.round((before - value) / 360)]);
      }
      const read = (share) => {
        const value = follows(curve.law, state.phase), near = run[Math.round(share * count)][1];
        return data.unit === "°" ? value + 360 * Math.round((near - value) / 360) : value;
      };
      return { ...curve, runs: [run], read };
    });
    const values = shown.curves.flatMap(({ runs }) => runs.flat().map(([, value]) => value)).filter(Number.isFinite);
    const [low, high] = ends(values), least = Math.max(1e-9 * Math.max(-low, high), 1e-12), room = high - low > least ? 0.06 * (high - low) : 0.5 * Math.abs(high) || 1;
    shown.y = [low - room, high + room];
    return shown;
  }

  // The runs and the reading of a curve that the page has as a table.
  function given({ course: [origin, scale, span] }, curve) {
    const { table, ends: parts } = curve, runs = [];
    for (let part = 1; part < parts.length; part++) {
      const from = parts[part - 1], long = parts[part] - from, count = Math.ceil(long * 600) + 1;
      let run = null;
      for (let n = 0; n <= count; n++) {
        // the end of a part, as a reading there is the beginning of the next
        const share = from + long * Math.min(n / count, 1 - 1e-9);
        const value = grown(reading(table, curve, share), curve, origin + scale * share * span);
        if (!Number.isFinite(value)) run = null;
        else (run ||= runs[runs.push([]) - 1]).push([share, value]);
      }
    }
    return { runs, read: (share) => grown(reading(table, curve, share), curve, state.phase) };
  }

  function layChart() {
    const data = charted(), wide = chart.clientWidth, tall = chart.clientHeight;
    chart.replaceChildren();
    cursor = null;
    if (!data || !wide || !tall) return;
    const words = (markup, x, y, anchor) => {
      const group = part(chart, "g", { transform: `translate(${x} ${y})` });
      group.innerHTML = markup;
      group.firstElementChild.setAttribute("text-anchor", anchor);
      return group.firstElementChild.getComputedTextLength();
    };
    // the quantity in words where there is room for them, else by its symbol
    const title = (x, room) => {
      if (words(data.titles[0], x, top - 21, "start") <= room) return;
      chart.lastElementChild.remove();
      words(data.titles[1], x, top - 21, "start");
    };
    const note = (text, x, y, anchor, more) => {
      say(part(chart, "text", { x, y, "text-anchor": anchor, "font-size": 12, fill: "var(--ink)", ...more }), text);
    };
    chart.setAttribute("aria-label", data.words);
    chart.classList.toggle("said", Boolean(data.unknown));
    const high = Math.min(tall, 0.62 * wide) - 62, top = (tall - high - 62) / 2 + 24, [low, up] = data.y, sign = data.unit === "°" ? "°" : "";
    if (data.unknown) {
      words(data.titles[0], 8, 2, "start");
      note(said("It is known for the page’s own lengths alone."), 8, 34, "start", {});
      return;
    }
    let most = clamp(Math.round(high / 24), 2, 6), levels = ticksOf(low, up, most, sign);
    while (high >= 90 && levels.length < 4 && most < 12) levels = ticksOf(low, up, ++most, sign);
    const left = 12 + 6.6 * Math.max(...levels.map(([, text]) => text.length)), width = wide - left - 16;
    const level = (value) => top + high * (1 - clamp((value - low) / (up - low), 0, 1));
    const [, , span] = data.course, along = (x) => left + width * x / span;
    for (const [value, text] of levels) {
      const zero = low < 0 && up > 0 && !value;
      stroked(chart, zero ? "var(--ink)" : data.rule, 1, { d: `M${left} ${level(value)}h${width}`, opacity: zero ? 0.6 : 1 });
      note(text, left - 5, level(value) + 4, "end", {});
    }
    for (const [value, text] of ticksOf(0, span, clamp(Math.round(width / 48), 2, 8), data.across)) {
      stroked(chart, data.rule, 1, { d: `M${along(value)} ${top}v${high}` });
      note(text, along(value), top + high + 15, "middle", {});
    }
    for (const [value, text] of data.marks) {
      stroked(chart, "var(--ink)", 1, { d: `M${along(value)} ${top}v${high}`, "stroke-dasharray": "4 4", opacity: 0.6 });
      note(text, Math.min(along(value) + 4, wide - 6.6 * text.length), top + 11, "start", {});
    }
    const told = 110 * data.curves.length;
    title(left, width - told);
    words(data.title, left + width, top + high + 20, "end");
    for (const { colour, runs } of data.curves) {
      const d = runs.map((run) => line(run.map(([share, value]) => [left + width * share, level(value)]))).join("");
      stroked(chart, colour, 2, { d });
    }
    const rule = stroked(chart, "var(--ink)", 1.2);
    const dots = data.curves.map(({ colour }) => part(chart, "circle", { r: 4.5, fill: colour, stroke: "var(--back)", "stroke-width": 1.5 }));
    const label = part(chart, "text", { x: left + width, y: top - 9, fill: "var(--ink)", "text-anchor": "end", "font-size": 13 });
    cursor = { data, rule, dots, label, level, left, top, width, high };
  }

  // Returns how far along a chart the cursor stands, 0 to 1; one over time begins with the period, or ends with it.
  function chartShare({ course: [origin, scale, span] }) {
    const along = mod((state.phase - origin) / scale, span) / span;
    if (!page.retraced || own?.on) return along;
    return scale > 0 ? shareOf(state.phase) : 1 - shareOf(state.phase);
  }

  function drawCursor() {
    if (!cursor) return;
    const { data, rule, dots, label, level, left, top, width, high } = cursor, share = chartShare(data), x = left + width * share;
    put(rule, "d", `M${x.toFixed(2)} ${top}v${high}`);
    say(label, data.curves.map(({ label: named, read }, n) => {
      const value = read(share);
      put(dots[n], "cx", x);
      put(dots[n], "cy", Number.isFinite(value) ? level(value) : -100);
      return `${named} ${words(value, data.digits, data.unit)}`.trim();
    }).join("   "));
  }

  function scrub(event) {
    if (!cursor) return;
    const { left, width, data: { course: [origin, scale, span] } } = cursor;
    const share = clamp((event.clientX - chart.getBoundingClientRect().left - left) / width, 0, 1);
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
          const [angle, turning] = turningOf({ tail, head }, pose), long = size(sub(pose(head).p, pose(tail).p).map(clear));
          text = `${link}: ω = ${short(turning)} rad/s\n${said("{length} at {angle}", { length: `${short(long / view[0])} ${page.unit}`, angle: `${short(angle)}°` })}`;
        }
      }
    }
    say(byId("reading"), text);
  }

  // Lays out the tables of all numbers: of points, of links and of forces, each cell with what it tells in a pose.
  let cells = [];
  function layNumbers(side, drawn) {
    const { unit: of } = page, { view, movers } = side.data;
    const put = (id, heads, rows) => {
      const table = byId(id), [head, body] = table.children;
      table.classList.toggle("off", !rows.length);
      const line = (of) => { const made = document.createElement("tr"); made.append(...of); return made; };
      const cell = (name, scope, inside) => Object.assign(document.createElement(name), { scope }, { innerHTML: inside });
      head.replaceChildren(line(heads.map((text) => cell("th", "col", text))));
      body.replaceChildren(...rows.map(({ name, keys, tells }) => line([mark(cell("th", "row", name), drawn([keys[0]]), true), ...tells.map((tell, n) => {
        const made = mark(document.createElement("td"), drawn([keys[n + 1] || keys[0]]), true);
        cells.push([made, tell]);
        return made;
      })])));
    };
    cells = [];
    put("points", [said("point"), `${said("position")} (${of})`, `${said("velocity")} (${of}/s)`, `${said("acceleration")} (${of}/s²)`], [...tracksNow().keys()].map((name) => ({
      name: escaped(Object.hasOwn(page.called, name) ? page.called[name] : name), keys: [`j ${name}`, `j ${name}`, `v ${name}`, `a ${name}`],
      tells: [(pose) => couple(inUnits(pose(name), view).place), (pose) => rates(inUnits(pose(name), view).velocity), (pose) => rates(inUnits(pose(name), view).acceleration)],
    })));
    const links = new Map(movers.filter(({ link, tail, head }) => link && tail !== head).map((mover) => [mover.link, mover]));
    put("links", [said("link"), `${said("angle")} (°)`, "ω (rad/s)", "α (rad/s²)"], [...links].map(([name, mover]) => ({
      name: escaped(name), keys: [`l ${name}`], tells: [0, 1, 2].map((order) => (pose) => short(turningOf(mover, pose)[order])),
    })));
    const [pulls] = own?.on ? [] : movers.filter(({ kind, order }) => kind === "arrows" && !order);
    put("forces", [said("force"), "x, y (N)", `${said("size")} (N)`], (pulls?.symbols || []).map((symbol, n) => {
      const step = 10 ** (Math.floor(Math.log10(pulls.grain[n] * 32000)) - 2), digits = Math.max(0, -Math.log10(step));
      const told = (x) => Number.isFinite(x) ? minus((Math.round(x / step) * step + 0).toFixed(digits).replace(/^-(0\.?0*)$/, "$1")) : "∞";
      const force = () => pulled(pulls, n, state.phase), slight = (f) => size(f) > 0 && size(f) < step / 2;
      const parts = (f) => slight(f) ? "–" : `(${f.map(told).join(", ")})`, whole = (f) => slight(f) ? `< ${told(step)}` : told(size(f));
      return { name: symbolic(symbol), keys: [`f ${symbol}`], tells: [() => parts(force()), () => whole(force())] };
    }));
  }
  const escaped = (text) => text.replace(/[&<]/g, (letter) => ({ "&": "&amp;", "<": "&lt;" })[letter]);
  const symbolic = (text) => escaped(text).replace(/_\{(.*)\}/, "<sub>$1</sub>");

  // Returns a link's angle in degrees, its angular velocity and its angular acceleration.
  function turningOf({ tail, head }, pose) {
    const [p, v, a] = ["p", "v", "a"].map((kind) => back(sub(pose(head)[kind], pose(tail)[kind]).map(clear)));
    const cross = (b) => (p[0] * b[1] - p[1] * b[0]) / size(p) ** 2, grow = (p[0] * v[0] + p[1] * v[1]) / size(p) ** 2;
    const angle = mod(Number(mod(Math.atan2(p[1], p[0]) * 180 / Math.PI, 360).toPrecision(4)), 360);
    const rate = (x) => Math.abs(x) < 2e-5 ? 0 : x;
    return [angle, rate(cross(v)) * speed(), rate(cross(a) - 2 * cross(v) * grow) * speed() ** 2];
  }

  function drawNumbers(pose) {
    for (const [cell, tell] of cells) say(cell, tell(pose));
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
    byId("play").textContent = on ? said("Pause") : said("Play");
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

  const handle = byId("handle");
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
    lay();
  }
  function showSide(number) {
    state.side = mod(number, sides.length);
    own?.renew();
    const { name } = now().data, button = byId("closure");
    button.textContent = name ? said("Closure: {name}", { name }) : said("Closure");
    button.classList.toggle("off", sides.length < 2);
    lay();
  }
  function reverse() {
    state.way = -state.way;
    byId("reverse").setAttribute("aria-pressed", state.way < 0);
    lay();
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
  for (const name of ["trace", "velocity", "acceleration", "force", "names", "values", "curves"]) ACTIONS[name] = () => toggle(name);
  for (const name in ACTIONS) byId(name).addEventListener("click", ACTIONS[name]);
  byId("pace").addEventListener("change", () => pace(0));
  byId("input").addEventListener("input", (event) => { pause(); moveTo(Number(event.target.value)); });
  byId("numbers").addEventListener("toggle", wake);

  const KEYS = {
    " ": ACTIONS.play, d: reverse, b: ACTIONS.closure, t: ACTIONS.trace, v: ACTIONS.velocity, a: ACTIONS.acceleration, f: ACTIONS.force,
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
  for (const [order, name] of ARROWS.entries())
    hide(name, !sides[0].data.movers.some((mover) => mover.kind === "arrows" && mover.order === order && mover.usual));
  hide("theme", Boolean(page.theme));
  hide("curves", !sides.some(({ charts }) => charts.length));
  // a low page, as in a slide's frame, leaves its room to the mechanism: numbers and chart come when asked for, and
  // where there is room beside it
  const { clientWidth: across, clientHeight: down } = byId("panes"), [, , broad, deep] = whole.split(" ").map(Number);
  const isLow = matchMedia("(max-height: 30rem) and (min-width: 34rem)").matches, free = across - down * broad / deep;
  state.values = !isLow || free > 190;
  state.curves = !isLow || free > 460;
  for (const name of ["values", "curves"]) byId(name).setAttribute("aria-pressed", state[name]);
  byId("rows").classList.toggle("off", !state.values);
  hide("lengths", !own);
  if (own) globalThis.lengths = own;
  const slider = byId("input");
  slider.min = 0;
  slider.setAttribute("aria-label", page.input);
  byId("grip").classList.remove("off");
  new ResizeObserver(() => { zoom = picture.getScreenCTM()?.a || 1; compose(); }).observe(byId("panes"));
  showSide(0);
  play(state.playing);
})();
