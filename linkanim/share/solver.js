// Solves a linkage of cranks, dyads (two bars; a bar and a slider on a fixed line; a slotted bar; a yoke on a
// fixed line) and points of bodies for any lengths. A point is [x, y] in the scene's unit, y up; a joint is {p, v, a}: its place and its first and
// second derivative by the input's angle. A dyad that does not close gives null.
"use strict";
const solverOf = (model) => {
  const TURN = 2 * Math.PI, SAMPLES = 1440, NONE = Object.create(null);
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
      gap = Math.min(u / (a + b) ** 2, w / (a + b) ** 2);
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
      gap = room / at(r) ** 2;
      if (!(room >= 0)) return null;
      const p = add(foot, by(way, dot(way, off) + side * flip * Math.sqrt(room))), bar = sub(p, P.p);
      const v = by(way, dot(bar, P.v) / dot(bar, way));
      return { p, v, a: by(way, (dot(bar, P.a) - square(sub(v, P.v))) / dot(bar, way)) };
    },
    // through = pivot + s·u + offset·n with s > 0 (on the other closure < 0), the joint pivot + r·u
    slot({ pivot, through, r, offset }, joints, _, flip) {
      const O = joints[pivot], A = joints[through], way = sub(A.p, O.p), e = at(offset), far = square(way);
      const room = far - e * e;
      gap = room / (far + e * e);
      if (!(room > 0)) return null;
      const s = flip * Math.sqrt(room), u = by(add(by(way, s), by(left(way), -e)), 1 / far), n = left(u);
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

  let gap = 0, stop = null, gaps = Object.create(null);

  // Returns all joints by name at an input's angle, null where the linkage does not close; `flips` is -1 for the
  // dyads on their other closure. Keeps how far each dyad, and which one of them most, is from not closing.
  function solve(angle, flips = NONE, of = model.joints) {
    // by name: an object with a prototype has names that nobody gave it, such as "constructor"
    const joints = Object.create(null);
    gaps = Object.create(null);
    let least = 1;
    stop = null;
    for (const joint of of) {
      gap = 1;
      joints[joint.name] = PLACE[joint.kind](joint, joints, angle, flips[joint.name] || 1);
      gaps[joint.name] = gap;
      if (gap < least) [least, stop] = [gap, joint.name];
      if (!joints[joint.name]) break;
    }
    gap = least;
    return joints[of[of.length - 1].name] ? joints : null;
  }

  // The dyads on the input's own pin and the ground, with what they stand on: they say which ranges there are.
  const pins = new Set(model.joints.filter(({ kind }) => kind === "pin").map(({ name }) => name));
  const ownEnds = ({ kind, ends, end, pivot, through }) => ({ bars: ends, slider: [end, model.ground], slot: [pivot, through] })[kind] || [];
  const isOwn = (joint) => ownEnds(joint).includes(model.drive) && ownEnds(joint).some((name) => pins.has(name));
  const own = model.joints.filter((joint) => joint.kind === "pin" || joint.name === model.drive || isOwn(joint));

  // Returns the stretches of a way, `at` shares 0 to 1 of which the input is, on which the linkage closes: [from, to] in
  // shares, each with the dyads that end it; a way that `turns` goes on where it ends. Null where it closes all along.
  function stretches(at, count, turns, flips, of) {
    const room = (share) => { solve(at(share), flips, of); return gap; };
    const marks = Array.from({ length: count + 1 }, (_, n) => [n / count, room(n / count)]);
    // a way's own ends are limits, at which rounding alone decides
    if (!turns) for (const [end, next] of [[0, 1], [count, count - 1]]) marks[end][1] = Math.min(marks[next][1], 0);
    for (let n = 1; n < count; n++) {
      const here = marks[n][1];
      if (here >= 0 && here <= marks[n - 1][1] && here <= marks[n + 1][1]) {
        const least = narrowest(room, marks[n - 1][0], marks[n + 1][0]);
        if (room(least) < 0) marks.push([least, room(least)]);
      }
    }
    marks.sort((one, other) => one[0] - other[0]);
    if (marks.every(([, here]) => here >= 0)) return null;
    const stopAt = (share) => { room(share); return stop; };
    const found = [];
    let from = marks[0][1] >= 0 ? [marks[0][0], null] : null;
    for (let n = 1; n < marks.length; n++) {
      const [[before, was], [here, is]] = [marks[n - 1], marks[n]];
      if (was < 0 && is >= 0) from = [limit(room, here, before), stopAt(before)];
      if (was >= 0 && is < 0) { found.push([from[0], limit(room, before, here), from[1], stopAt(here)]); from = null; }
    }
    if (from) found.push([from[0], marks[marks.length - 1][0], from[1], null]);
    const [first, last] = [found[0], found[found.length - 1]];
    if (turns && found.length && first[0] === 0 && last[1] === 1) {
      found.shift();
      found.pop();
      found.push([last[0], 1 + first[1], last[2], first[3]]);
    }
    return found;
  }

  // Returns the place between two at which the room changes its sign.
  function limit(room, closed, open) {
    for (let n = 0; n < 80; n++) {
      const middle = (closed + open) / 2;
      if (room(middle) >= 0) closed = middle; else open = middle;
    }
    return closed;
  }

  // Returns where the room is least between two places.
  function narrowest(room, low, high) {
    const golden = (Math.sqrt(5) - 1) / 2;
    for (let n = 0; n < 60; n++) {
      const one = high - golden * (high - low), other = low + golden * (high - low);
      if (room(one) < room(other)) high = other; else low = one;
    }
    return (low + high) / 2;
  }

  // Returns how far the input goes: the whole turn, as null; or {low, high, stops}, the angles of the stretch that has
  // its start, and the dyads that stop it there; undefined where it closes nowhere. Of two ranges that the input's own
  // pin leaves open it is the one that has a stated start, else the one above the ground line.
  function range(flips = NONE) {
    const arcs = stretches((share) => model.start + TURN * share, SAMPLES, true, flips, own);
    if (arcs) return arcs.length ? within(arcOf(arcs), flips) : undefined;
    const whole = TURN * model.turns, at = (share) => model.start + whole * share;
    const found = stretches(at, SAMPLES * model.turns * model.quickness, true, flips);
    if (!found) return null;
    const chosen = around(found.concat(found.map(([from, to, ...stops]) => [from - 1, to - 1, ...stops])), 0);
    return chosen && { low: at(chosen[0]), high: at(chosen[1]), stops: chosen.slice(2) };
  }

  function arcOf(arcs) {
    const found = arcs.map(([low, high, ...stops]) => ({ low: model.start + TURN * low, high: model.start + TURN * high, stops }));
    const turns = (angle, low) => angle - TURN * Math.floor((angle - low) / TURN);
    const named = model.stated === null ? null : found.find(({ low, high }) => turns(model.stated, low) <= high);
    const above = ({ low, high }) => Math.sin((low + high) / 2 - model.level);
    const chosen = named || found.sort((one, other) => above(other) - above(one))[0];
    const shift = TURN * Math.round(((model.stated ?? model.level) - (chosen.low + chosen.high) / 2) / TURN);
    return { low: chosen.low + shift, high: chosen.high + shift, stops: chosen.stops };
  }

  // Returns the part of an arc on which all dyads close, around the start; by its phase, in which its ends are clear.
  function within({ low, high, stops }, flips) {
    const middle = (low + high) / 2, reach = (high - low) / 2, at = (share) => middle - reach * Math.cos(Math.PI * share);
    const found = stretches(at, SAMPLES * model.quickness, false, flips);
    if (!found) return { low, high, stops };
    const away = model.start - middle - TURN * Math.round((model.start - middle) / TURN);
    const chosen = around(found, Math.acos(Math.min(Math.max(-away / reach, -1), 1)) / Math.PI);
    if (!chosen) return undefined;
    const ends = chosen[2] ? at(chosen[0]) : low, last = chosen[3] ? at(chosen[1]) : high;
    return { low: ends, high: last, stops: [chosen[2] || stops[0], chosen[3] || stops[1]] };
  }

  // Returns the stretch that has a place, else the widest, the nearest of equals, or the first of those.
  function around(found, home) {
    const has = found.find(([from, to]) => from <= home && home <= to);
    const far = ([from, to]) => Math.abs((from + to) / 2 - home), wide = ([from, to]) => to - from;
    const most = Math.max(...found.map(wide));
    const alike = found.filter((one) => wide(one) >= most - 1e-9), least = Math.min(...alike.map(far));
    return has || alike.filter((one) => far(one) <= least + 1e-9).sort((one, other) => one[0] - other[0])[0];
  }

  // Returns how a swing runs: at which ends it `keeps` its closures, coming back as it went, and from which phase to
  // which it goes before that; else it goes on through the limit, onto the other closure of the dyad that stops it,
  // provided that all dyads close all the way, and have their limits where they had them.
  function course({ low, high, stops }, flips = NONE) {
    const ways = model.retraced ? [[true, true]] : [[false, false], [true, false], [false, true], [true, true]];
    const middle = (low + high) / 2, reach = (high - low) / 2;
    for (const keeps of ways) {
      const [first, last] = [keeps[0] ? 0 : -Math.PI, keeps[1] ? Math.PI : TURN];
      const free = !keeps[0] && !keeps[1], long = free ? (stops[0] === stops[1] ? 1 : 2) * TURN : last - first;
      const found = {
        keeps, first, last, free, periods: Math.round((free ? long : 2 * long) / TURN),
        flips: (phase) => {
          const turned = Object.assign(Object.create(null), flips);
          stops.forEach((name, end) => {
            const side = end ? Math.cos(phase / 2) : Math.sin(phase / 2);
            if (!keeps[end] && side < 0) turned[name] = -(turned[name] || 1);
          });
          return turned;
        },
      };
      const count = 720 * Math.ceil(long / Math.PI), begin = free ? 0 : first;
      const closes = (n) => {
        const phase = begin + long * n / count, joints = solve(middle - reach * Math.cos(phase), found.flips(phase));
        const end = Math.round(phase / Math.PI), there = Math.abs(phase - end * Math.PI) < 1e-9;
        return there ? Math.abs(gaps[stops[Math.abs(end) % 2]]) < 1e-6 : joints !== null;
      };
      if (keeps[0] && keeps[1] || Array.from({ length: count + 1 }, (_, n) => n).every(closes)) return found;
    }
    return null;
  }

  // Returns the class of a single four-bar with Grashof's sums; null of another linkage.
  function grashof() {
    if (!model.fourBar) return null;
    const [ground, input, coupler, output] = model.fourBar.map(at), links = [ground, input, coupler, output];
    const [s, p, q, l] = links.slice().sort((one, other) => one - other);
    const margin = p + q - s - l, least = links.indexOf(s);
    const { grashof: grashofs, rockers, change: changes } = model.classes, most = links.indexOf(l);
    const sign = Math.abs(margin) <= 2 ** -53 * (s + p + q + l) ? 0 : Math.sign(margin);
    const name = [rockers[most], changes[least], grashofs[least]][sign + 1];
    return { name, sums: [s + l, p + q], sign };
  }

  return {
    values, solve, range, course, grashof,
    set(number, value) { values[number] = value; },
  };
};
