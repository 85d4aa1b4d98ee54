// Solves a linkage of cranks, dyads (two bars; a bar and a slider on a fixed line; a slotted bar; a yoke on a
// fixed line) and points of bodies for any lengths. A point is [x, y] in the scene's unit, y up; a joint is {p, v, a}: its place and its first and
// second derivative by the input's angle. A dyad that does not close gives null.
"use strict";
const solverOf = (model) => {
  const TURN = 2 * Math.PI, SAMPLES = 1440;
  const add = (a, b) => [a[0] + b[0], a[1] + b[1]];
  const sub = (a, b) => [a[0] - b[0], a[1] - b[1]];
  const by = (a, k) => [a[0] * k, a[1] * k];
  const left = (a) => [-a[1], a[0]];
  const dot = (a, b) => a[0] * b[0] + a[1] * b[1];
  const cross = (a, b) => a[0] * b[1] - a[1] * b[0];
  const square = (a) => dot(a, a);
  const STILL = [0, 0];
  const values = model.values.slice();
  const at = (number) => values[number];

  // Returns u with one·u = right[0] and other·u = right[1].
  const crossed = (one, other, right) => {
    const det = cross(one, other);
    return [(right[0] * other[1] - right[1] * one[1]) / det, (one[0] * right[1] - other[0] * right[0]) / det];
  };

  const PLACE = {
    pin({ base, way, r, place }, joints) {
      return { p: base === undefined ? place : add(joints[base].p, by(way, at(r))), v: STILL, a: STILL };
    },
    crank({ pivot, r, ratio, offset }, joints, angle) {
      const turned = ratio * angle + offset, arm = by([Math.cos(turned), Math.sin(turned)], at(r)), base = joints[pivot];
      return { p: add(base.p, arm), v: add(base.v, by(left(arm), ratio)), a: add(base.a, by(arm, -ratio * ratio)) };
    },
    // U = (a + b)² - L² and W = L² - (a - b)² are negative where the ends are too far apart, or too near
    bars({ ends, r, side }, joints, _, flip) {
      const [P, Q] = ends.map((name) => joints[name]), [a, b] = r.map(at), way = sub(Q.p, P.p);
      const apart = Math.hypot(...way), u = (a + b - apart) * (a + b + apart), w = (apart - a + b) * (apart + a - b);
      gap = Math.min(gap, u / (a + b) ** 2, w / (a + b) ** 2);
      if (!(u >= 0 && w >= 0)) return null;
      const ahead = (apart + (a - b) * (a + b) / apart) / 2, aside = side * flip * Math.sqrt(u * w) / (2 * apart);
      const p = add(P.p, add(by(way, ahead / apart), by(left(way), aside / apart)));
      const one = sub(p, P.p), other = sub(p, Q.p);
      const v = crossed(one, other, [dot(one, P.v), dot(other, Q.v)]);
      const turned = [square(sub(v, P.v)), square(sub(v, Q.v))];
      return { p, v, a: crossed(one, other, [dot(one, P.a) - turned[0], dot(other, Q.a) - turned[1]]) };
    },
    slider({ end, r, through, way, offset, side }, joints, _, flip) {
      const P = joints[end], foot = add(joints[through].p, by(left(way), at(offset))), off = sub(P.p, foot);
      const aside = cross(way, off), room = (at(r) - aside) * (at(r) + aside);
      gap = Math.min(gap, room / at(r) ** 2);
      if (!(room >= 0)) return null;
      const p = add(foot, by(way, dot(way, off) + side * flip * Math.sqrt(room))), bar = sub(p, P.p);
      const v = by(way, dot(bar, P.v) / dot(bar, way));
      return { p, v, a: by(way, (dot(bar, P.a) - square(sub(v, P.v))) / dot(bar, way)) };
    },
    // through = pivot + s·u + offset·n with s > 0, the joint pivot + r·u
    slot({ pivot, through, r, offset }, joints) {
      const O = joints[pivot], A = joints[through], way = sub(A.p, O.p), e = at(offset), far = square(way);
      const room = far - e * e;
      gap = Math.min(gap, room / (far + e * e));
      if (!(room > 0)) return null;
      const s = Math.sqrt(room), u = by(add(by(way, s), by(left(way), -e)), 1 / far), n = left(u);
      const v = sub(A.v, O.v), a = sub(A.a, O.a), turn = dot(v, n) / s, slid = dot(v, u) + turn * e;
      const second = (dot(a, n) - turn * (dot(v, u) + slid)) / s, long = at(r);
      return {
        p: add(O.p, by(u, long)), v: add(O.v, by(n, long * turn)),
        a: add(O.a, sub(by(n, long * second), by(u, long * turn * turn))),
      };
    },
    // where a slot of a fixed direction through a pin crosses a fixed line
    yoke({ pin, way, slot, through, offset }, joints) {
      const P = joints[pin], foot = add(joints[through].p, by(left(way), at(offset))), det = cross(way, slot);
      const along = (of) => by(way, cross(of, slot) / det);
      return { p: add(foot, along(sub(P.p, foot))), v: along(P.v), a: along(P.a) };
    },
    point({ on, r }, joints) {
      const [P, Q] = on.map((name) => joints[name]), way = sub(Q.p, P.p), long = square(way);
      const [along, aside] = r.map((number) => at(number) / Math.sqrt(long));
      const arm = add(by(way, along), by(left(way), aside));
      const rate = cross(way, sub(Q.v, P.v)) / long, second = cross(way, sub(Q.a, P.a)) / long;
      return {
        p: add(P.p, arm), v: add(P.v, by(left(arm), rate)),
        a: add(P.a, sub(by(left(arm), second), by(arm, rate * rate))),
      };
    },
  };

  let gap = 0, stop = null;

  // Returns all joints by name at an input's angle, null where the linkage does not close; `flips` is -1 for the
  // dyads on their other closure.
  function solve(angle, flips = Object.create(null)) {
    // by name: an object with a prototype has names that nobody gave it, such as "constructor"
    const joints = Object.create(null);
    gap = 1;
    for (const joint of model.joints) {
      const before = gap;
      joints[joint.name] = PLACE[joint.kind](joint, joints, angle, flips[joint.name] || 1);
      if (gap < before) stop = joint.name;
      if (!joints[joint.name]) return null;
    }
    return joints;
  }

  // Returns the dyad that is nearest to not closing at an angle.
  const stopAt = (angle) => { solve(angle); return stop; };

  // Returns how far the linkage is from not closing: negative where it does not.
  const room = (angle) => { solve(angle); return gap; };

  // Returns the place between two at which the room changes its sign.
  function limit(closed, open) {
    for (let n = 0; n < 80; n++) {
      const middle = (closed + open) / 2;
      if (room(middle) >= 0) closed = middle; else open = middle;
    }
    return closed;
  }

  // Returns where the room is least between two angles.
  function narrowest(low, high) {
    const golden = (Math.sqrt(5) - 1) / 2;
    for (let n = 0; n < 60; n++) {
      const one = high - golden * (high - low), other = low + golden * (high - low);
      if (room(one) < room(other)) high = other; else low = one;
    }
    return (low + high) / 2;
  }

  // Returns how far the input goes: the whole turn, as null; or [low, high] of the stretch that has its start,
  // else of the one above the ground line; undefined where it closes nowhere.
  function range() {
    const step = TURN / SAMPLES, angles = Array.from({ length: SAMPLES }, (_, n) => model.start + n * step);
    const rooms = angles.map(room), marks = [];
    rooms.forEach((here, n) => {
      marks.push([angles[n], here]);
      const before = rooms[(n + SAMPLES - 1) % SAMPLES], after = rooms[(n + 1) % SAMPLES];
      if (here >= 0 && here <= before && here <= after) {
        const least = narrowest(angles[n] - step, angles[n] + step);
        if (room(least) < 0) marks.push([least, room(least)]);
      }
    });
    marks.sort((one, other) => one[0] - other[0]);
    if (marks.every(([, here]) => here >= 0)) return null;
    const first = marks.findIndex(([, here]) => here < 0), count = marks.length, found = [];
    let low = null;
    for (let n = first; n <= first + count; n++) {
      const turned = (number) => marks[number % count][0] + (number >= count ? TURN : 0);
      const closed = marks[n % count][1] >= 0;
      if (closed && low === null) low = limit(turned(n), turned(n - 1));
      if (!closed && low !== null) { found.push([low, limit(turned(n - 1), turned(n))]); low = null; }
    }
    const turns = (angle, [from]) => angle - TURN * Math.floor((angle - from) / TURN);
    const named = model.stated === null ? null : found.find((one) => turns(model.stated, one) <= one[1]);
    const above = (one) => Math.sin((one[0] + one[1]) / 2 - model.level);
    const chosen = named || found.sort((one, other) => above(other) - above(one))[0];
    if (!chosen) return undefined;
    const middle = (chosen[0] + chosen[1]) / 2;
    const shift = TURN * Math.round((model.level - middle) / TURN);
    return [chosen[0] + shift, chosen[1] + shift];
  }

  // Returns the class of a single four-bar with Grashof's sums; null of another linkage.
  function grashof() {
    if (!model.fourBar) return null;
    const [ground, input, coupler, output] = model.fourBar.map(at), links = [ground, input, coupler, output];
    const [s, p, q, l] = links.slice().sort((one, other) => one - other);
    const margin = p + q - s - l, least = links.indexOf(s);
    const { grashof: grashofs, rockers, change } = model.classes, most = links.indexOf(l);
    const sign = Math.abs(margin) <= 2 ** -53 * (s + p + q + l) ? 0 : Math.sign(margin);
    const name = [`triple-rocker (${rockers[most]})`, `${change} ${grashofs[least]}`, `Grashof ${grashofs[least]}`][sign + 1];
    return { name, sums: [s + l, p + q], sign };
  }

  return {
    values, solve, range, grashof, stopAt,
    set(number, value) { values[number] = value; },
  };
};
