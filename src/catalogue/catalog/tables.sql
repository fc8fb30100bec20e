CREATE TABLE meta (
  key TEXT PRIMARY KEY,            -- spec: what the catalogue holds, as TOML; ozols: the version that made it
  value TEXT NOT NULL
) WITHOUT ROWID;
CREATE TABLE parts (               -- parts of the structures that are all there
  part TEXT PRIMARY KEY,           -- 3/7, the third of seven; 1/1 is the whole
  structures INTEGER NOT NULL      -- how many it has
) WITHOUT ROWID;
CREATE TABLE structures (
  id TEXT PRIMARY KEY,             -- short name: number of links, and the beginning of the SHA-256 of the whole name
  name TEXT NOT NULL UNIQUE,       -- whole name: chain, frame-driver, jaws, input, symmetry; with pairs their code, frame, input, jaws, symmetry
  chain TEXT NOT NULL,             -- graph6 of the canonical numbering
  links INTEGER NOT NULL,
  joints INTEGER NOT NULL,
  frame INTEGER NOT NULL,          -- links by their canonical numbers
  driver INTEGER NOT NULL,
  jaw_a INTEGER NOT NULL,
  jaw_b INTEGER NOT NULL,
  jaw_c INTEGER,                   -- NULL where there are two
  input TEXT NOT NULL,             -- slide, turn
  symmetry TEXT NOT NULL,          -- generic, mirror, half-turn, threefold; -but-input where it carries the input joint elsewhere
  parallel INTEGER NOT NULL,       -- 1: each jaw stands on a parallelogram
  jaws_at_frame INTEGER NOT NULL,  -- how many jaws are joined to the frame
  truss INTEGER NOT NULL,          -- 1: a truss with a part hinged to both jaws, and no smaller part is; only of two jaws and hinges
  graph_symmetric INTEGER NOT NULL,
  no_layout TEXT                   -- why it has no layout; NULL where it has one
) WITHOUT ROWID;
CREATE TABLE layouts (
  structure TEXT PRIMARY KEY REFERENCES structures(id),
  mechanism TEXT NOT NULL,         -- the mechanism file, TOML
  start INTEGER NOT NULL,          -- the start of the search for places it was found from
  crossings INTEGER NOT NULL,      -- of links, and of pins on other links
  link_ratio REAL NOT NULL,        -- longest link over shortest
  area REAL NOT NULL,              -- of the box round pins, tips and pitch circles, mm2
  opening_min REAL NOT NULL,       -- of what is reached of the task's stroke, mm; of three jaws twice the tips' mean distance from the middle
  opening_max REAL NOT NULL,
  travel REAL NOT NULL,            -- of the drive between them, mm or rad
  closes INTEGER NOT NULL,         -- which way the drive goes to grip: 1 along x or counter-clockwise, -1 the other
  force_min REAL NOT NULL,         -- force of each jaw over the drive's, without friction; N for 1 Nm where it turns
  force_mean REAL NOT NULL,        -- over the opening: the drive's travel over it
  force_max REAL NOT NULL,
  jaw_a_motion TEXT NOT NULL,      -- parallel, swinging, floating
  jaw_b_motion TEXT NOT NULL,
  jaw_c_motion TEXT,
  tip_a_dx REAL NOT NULL,          -- how the tips move as they grip, mm for 1 mm or 1 rad of the drive
  tip_a_dy REAL NOT NULL,
  tip_b_dx REAL NOT NULL,
  tip_b_dy REAL NOT NULL,
  tip_c_dx REAL,
  tip_c_dy REAL,
  jaw_turn REAL NOT NULL,          -- the most that a jaw turns over the stroke, degrees
  ends_closing TEXT,               -- jaws-turn-back, dead-point, singular: why the stroke ends before the task's; NULL where it does not
  ends_opening TEXT,
  mobility INTEGER NOT NULL,       -- W as built
  redundant INTEGER NOT NULL,      -- sigma as built
  finite TEXT NOT NULL,            -- the full-cycle mobility, and how it is known
  determinate NOT NULL,            -- variants with sigma = 0: a number, or its digits as text beyond 63 bits
  determinate_w1 NOT NULL,         -- of these, W = 1
  orbits_w1 NOT NULL,              -- of these, up to the symmetry of the layout
  certainty TEXT NOT NULL,         -- "exact" or "at least"
  best_cost REAL                   -- of the cheapest variant with sigma = 0 and W = 1; of those found, if the certainty is "at least"
) WITHOUT ROWID;
CREATE TABLE strokes (             -- what a layout does of the task it was made for
  structure TEXT PRIMARY KEY REFERENCES structures(id),
  narrowest REAL NOT NULL,         -- the part widths asked, mm
  widest REAL NOT NULL,
  reached INTEGER NOT NULL,        -- 1: the jaws come as far together and apart as that
  force_ratio REAL NOT NULL,       -- greatest force of a jaw over the least, over what is reached of the stroke
  transmission REAL NOT NULL,      -- least angle over the stroke, of rods and by joint forces at driver and jaws, degrees
  pin_force REAL NOT NULL,         -- greatest joint force over the stroke, N for 1 N of each jaw
  efficiency REAL NOT NULL,        -- least over the stroke with the friction of the task; to a half it holds itself
  width REAL NOT NULL,             -- of the box round pins, tips and pitch circles over the stroke, mm
  height REAL NOT NULL,
  margin_closing REAL NOT NULL,    -- how far the jaws could go beyond the task before the stroke ends, mm; at most a fifth of it
  margin_opening REAL NOT NULL,
  shortfall TEXT                   -- the worst of what the task asks and this does not; NULL where it does all of it
) WITHOUT ROWID;
CREATE TABLE planes (              -- parallel planes in which the links of a layout pass each other over the stroke
  structure TEXT PRIMARY KEY REFERENCES structures(id),
  planes INTEGER,                  -- the fewest in which nothing meets, the frame's plates included; NULL where something always does
  links TEXT                       -- the links in each from the back, 0 | 1 3 | 2 4; the frame again at the end where it has a plate in front
) WITHOUT ROWID;
CREATE TABLE pairs ( -- of structures with slides, gears or slots
  structure TEXT PRIMARY KEY REFERENCES structures(id),
  code TEXT NOT NULL,              -- a letter for each two links, (0, 1), (0, 2), (1, 2)...: R hinge, P slide, G gear or rack, S slot, D two slots, - none
  slides INTEGER NOT NULL,         -- how many
  gears INTEGER NOT NULL,
  slots INTEGER NOT NULL,
  driven_from INTEGER NOT NULL     -- the link that the driver moves against: the frame, or another that moves
) WITHOUT ROWID;
CREATE TABLE prices (              -- of parts, in revolute joints: whoever knows better may change them
  part TEXT PRIMARY KEY,           -- hinge, slide, gear (a pair, or a rack and its pinion), slot (with its pin), link
  price REAL NOT NULL
) WITHOUT ROWID;
CREATE TABLE classics ( -- well-known schemes that have a structure
  structure TEXT NOT NULL REFERENCES structures(id),
  id TEXT NOT NULL,                -- a word for it, such as wedge-hook
  about TEXT NOT NULL,             -- what it is
  PRIMARY KEY (structure, id)
) WITHOUT ROWID;
CREATE TABLE counts (
  structure TEXT NOT NULL,
  mobility INTEGER NOT NULL,
  changes INTEGER NOT NULL,
  variants NOT NULL,               -- determinate variants of this mobility and so many changes
  orbits NOT NULL,                 -- these up to the symmetry of the layout; the same number without a symmetry
  symmetric NOT NULL,              -- of the variants those that are their own image, an orbit each; the rest are two to an orbit, three if threefold
  PRIMARY KEY (structure, mobility, changes)
) WITHOUT ROWID;
CREATE TABLE ideas (
  structure TEXT NOT NULL,
  place INTEGER NOT NULL,          -- from 1: symmetric ones first, then the cheapest, which is always among them
  changes TEXT NOT NULL,           -- the first variant of the idea: jaw-a.link-1, jaw-b.link-3 -> spherical
  choices TEXT NOT NULL,           -- its options, joint by joint, 0 if unchanged
  cost REAL NOT NULL,
  change_count INTEGER NOT NULL,
  variants NOT NULL,               -- how many variants the idea represents; a lower bound if the layout's certainty is "at least"
  peak_force REAL,                 -- greatest joint force over capacity under the workload
  peak_moment REAL,
  output_error REAL,               -- of the jaws from the joints' clearances, mm
  PRIMARY KEY (structure, place)
) WITHOUT ROWID;
CREATE VIEW grippers AS            -- layouts by what a designer asks of them
SELECT s.id, s.links, s.input, s.symmetry, s.parallel,
  l.jaw_a_motion || CASE WHEN l.jaw_b_motion <> l.jaw_a_motion THEN ' and ' || l.jaw_b_motion ELSE '' END
    || CASE WHEN l.jaw_c_motion NOT IN (l.jaw_a_motion, l.jaw_b_motion) THEN ' and ' || l.jaw_c_motion ELSE '' END AS jaws,
  l.force_min AS least_force,
  k.force_ratio, l.opening_min AS narrowest, l.opening_max AS widest, l.jaw_turn AS turn,
  k.transmission, k.pin_force, k.efficiency, l.travel, k.width, k.height, l.best_cost AS cost, l.determinate_w1 AS redesigns,
  k.reached, k.shortfall, coalesce(p.slides, s.input = 'slide') AS slides, coalesce(p.gears, 0) AS gears,
  coalesce(p.slots, 0) AS slots, b.planes,
  -- of all links and joints as built and of the cheapest redesign, in revolute joints
  l.best_cost + (SELECT sum(price * CASE part WHEN 'link' THEN s.links WHEN 'slide' THEN coalesce(p.slides, s.input = 'slide')
    WHEN 'gear' THEN coalesce(p.gears, 0) WHEN 'slot' THEN coalesce(p.slots, 0)
    ELSE s.joints - coalesce(p.slides + p.gears + p.slots, s.input = 'slide') END) FROM prices) AS price,
  -- work that the drive has to be made for, mm: its travel by its greatest force, N (or moment, N mm, by rad), for 1 N of each jaw
  round(l.travel * CASE s.input WHEN 'turn' THEN 1000 ELSE 1 END / (l.force_min * k.efficiency), 2) AS actuator
FROM structures s JOIN layouts l ON l.structure = s.id LEFT JOIN strokes k ON k.structure = s.id
  LEFT JOIN planes b ON b.structure = s.id
  LEFT JOIN pairs p ON p.structure = s.id;
CREATE VIEW front AS               -- of those that do the task, what no other with the same input beats: as good in all seven, better in one
SELECT a.id, a.links, a.price, a.least_force, a.pin_force, a.turn, a.width * a.height AS area, a.actuator, a.input
FROM grippers a
WHERE a.price IS NOT NULL AND a.reached = 1 AND a.shortfall IS NULL AND NOT EXISTS (
  SELECT 1 FROM grippers b
  WHERE b.price IS NOT NULL AND b.reached = 1 AND b.shortfall IS NULL AND b.input = a.input
    AND b.links <= a.links AND b.price <= a.price AND b.actuator <= a.actuator AND b.least_force >= a.least_force AND b.pin_force <= a.pin_force
    AND b.turn <= a.turn AND b.width * b.height <= a.width * a.height
    AND (b.links < a.links OR b.price < a.price OR b.actuator < a.actuator OR b.least_force > a.least_force OR b.pin_force < a.pin_force
      OR b.turn < a.turn OR b.width * b.height < a.width * a.height));
CREATE VIEW idea_front AS          -- ideas that no other of their structure beats in cost, peak force and moment, and error
SELECT i.* FROM ideas i
WHERE i.peak_force IS NOT NULL AND NOT EXISTS (
  SELECT 1 FROM ideas j
  WHERE j.structure = i.structure AND j.cost <= i.cost AND j.peak_force <= i.peak_force
    AND j.peak_moment <= i.peak_moment AND j.output_error <= i.output_error
    AND (j.cost < i.cost OR j.peak_force < i.peak_force OR j.peak_moment < i.peak_moment
      OR j.output_error < i.output_error));
