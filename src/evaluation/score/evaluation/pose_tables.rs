//! Everything about a search that does not depend on the variant, in numbers, pose by pose.

use crate::closure::drive::Driven;
use crate::closure::twist::unit_twist;
use crate::closure::twist::{FrameValues, MotionSpace};
use crate::geom::Reals;
use crate::geom::vector::{across, cross, unit};
use crate::model::joint_type::Freedom;
use crate::model::mechanism::{Joint, JointId, JointOption, LinkId, Mechanism, StateId};
use crate::motion::pose::Pose;
use crate::score::evaluation::coupled::{CoupledChoice, PlacedCoupling, couplings_at};
use crate::score::evaluation::load_cases::LoadCase;
use crate::score::joint_types::JointTypes;
use crate::search::Search;
use crate::search::question::space::Choice;
use crate::statics::reactions::Unsolved;
use crate::statics::reactions::geometry::{
    FreedomColumn, Geometry, Six, force_wrench, shift_wrench, wrench_power,
};
use crate::statics::reactions::loads::link_loads;
use crate::statics::reactions::loads::range_period;

/// The joints that a choice puts at one place.
#[derive(Debug, Clone)]
pub(in crate::score) struct Cell {
    /// Equations, each its twist in the wrench basis, its entries in the couplings, and then its right sides.
    pub(in crate::score) rows: Vec<Vec<f64>>,
    /// Σ of outer products of these but the right sides, dim and couplings wide.
    pub(in crate::score) gram: Vec<f64>,
    /// Force, and moment where it bears one, of the joints in series.
    pub(in crate::score) bears: Vec<(f64, Option<f64>)>,
    /// Sum of their clearances `[m]`.
    pub(in crate::score) clearance: f64,
    /// Its effect on each coupling at the joint.
    pub(in crate::score) coupled: Vec<CoupledChoice>,
}

/// A joint's place.
#[derive(Debug, Clone)]
pub(in crate::score) struct PlacedJoint {
    pub(in crate::score) joint: JointId,
    pub(in crate::score) variable: usize,
    /// Place in the variable's list of joints.
    pub(in crate::score) slot: usize,
    /// Contours through it, with their directions.
    pub(in crate::score) contours: Vec<(usize, f64)>,
    pub(in crate::score) point: [f64; 3],
    /// Direction of its drive, and whether that is a shift.
    pub(in crate::score) held: Option<([f64; 3], bool)>,
    /// Wrench of each load case along the tree.
    pub(in crate::score) along_tree: Vec<Six>,
    /// The couplings it is tied by.
    pub(in crate::score) couplings: Vec<PlacedCoupling>,
}

/// A pose.
#[derive(Debug, Clone)]
pub(in crate::score) struct PoseTable {
    pub(in crate::score) basis: Vec<Six>,
    pub(in crate::score) contours: usize,
    pub(in crate::score) couplings: usize,
    pub(in crate::score) size: f64,
    /// Load cases: the loads, then a unit force along each axis on each output.
    pub(in crate::score) cases: usize,
    pub(in crate::score) places: Vec<PlacedJoint>,
    /// By variable, choice, joint of the variable.
    pub(in crate::score) cells: Vec<Vec<Vec<Cell>>>,
    /// Greatest component of the first case's wrenches.
    pub(in crate::score) scale: f64,
}

impl PlacedJoint {
    /// Creates a joint at its place, without a variable or loads.
    fn of(geometry: &Geometry, drives: &[Driven], joint: JointId) -> PlacedJoint {
        let contours = geometry.contours.iter().enumerate();
        let through = contours.filter_map(|(k, contour)| {
            let forward = contour.direction_of(joint)?;
            Some((k, if forward { 1.0 } else { -1.0 }))
        });
        let held = drives.iter().find(|(j, _)| *j == joint);
        let held = held.filter(|(_, f)| *f != Freedom::Screw);
        PlacedJoint {
            joint,
            variable: 0,
            slot: 0,
            contours: through.collect(),
            point: geometry.points[joint],
            held: held.map(|(_, f)| (geometry.axes[joint][f.axis()], f.is_slide())),
            along_tree: Vec::new(),
            couplings: couplings_at(geometry, joint),
        }
    }
}

/// Returns the wrench on every link in each load case. The wrenches of the loads come first, then those of a unit force
/// along each axis on each output.
fn wrenches_at(
    m: &Mechanism,
    geometry: &Geometry,
    outputs: &[(LinkId, [f64; 3])],
    drives: &[Driven],
    LoadCase { drive, pose, loads }: &LoadCase,
) -> Vec<Vec<Six>> {
    let mut out = vec![link_loads(
        m,
        loads,
        geometry,
        pose,
        *drive,
        range_period(drives),
    )];
    for &(link, point) in outputs {
        let at = geometry.point_position(pose, link, point);
        for axis in 0..3 {
            let mut force = [0.0; 3];
            force[axis] = 1.0;
            let mut on_links = vec![[0.0; 6]; m.links.len()];
            on_links[link] = geometry.carried_part(&force_wrench(at, force, [0.0; 3]));
            out.push(on_links);
        }
    }
    out
}

/// Returns the joints that a choice puts in series, each with whether it is the original one.
fn in_series<'j>(
    joint: &'j Joint,
    choice: &Choice,
) -> impl Iterator<Item = (&'j JointOption, bool)> {
    let option = joint.options.get(choice.option);
    let option = option.map(|o| (o, choice.option == 0));
    let unloading = choice.unloading.and_then(|u| joint.unloading.get(u));
    option.into_iter().chain(unloading.map(|o| (o, false)))
}

impl PoseTable {
    pub(in crate::score) fn new(
        search: &Search,
        types: &JointTypes,
        outputs: &[(LinkId, [f64; 3])],
        drives: &[Driven],
        case: &LoadCase,
    ) -> Result<PoseTable, Unsolved> {
        let (m, pose) = (&*search.mechanism, &case.pose);
        let geometry = Geometry::new(m, StateId::FREE, pose)?;
        let cases = wrenches_at(m, &geometry, outputs, drives, case);
        let along: Vec<Vec<Six>> = cases
            .iter()
            .map(|c| geometry.along_tree(m.joints.len(), c))
            .collect();
        let scale = along[0]
            .iter()
            .flatten()
            .fold(0.0, |a: f64, x| a.max(x.abs()));
        let (mut places, mut cells) = (Vec::new(), Vec::new());
        for (v, variable) in search.space.variables.iter().enumerate() {
            let mut of_variable = vec![Vec::new(); variable.choices.len()];
            for &joint in &variable.joints {
                if !geometry.joints.contains(&joint) {
                    continue;
                }
                let place = PlacedJoint {
                    variable: v,
                    slot: of_variable.first().map_or(0, Vec::len),
                    along_tree: along.iter().map(|a| a[joint]).collect(),
                    ..PlacedJoint::of(&geometry, drives, joint)
                };
                for (choice, out) in variable.choices.iter().zip(&mut of_variable) {
                    let series = in_series(&m.joints[joint], choice);
                    out.push(cell_at(m, &geometry, pose, types, drives, &place, series)?);
                }
                places.push(place);
            }
            cells.push(of_variable);
        }
        Ok(PoseTable {
            basis: geometry.basis.clone(),
            contours: geometry.contours.len(),
            couplings: geometry.couplings.len(),
            size: geometry.size,
            cases: cases.len(),
            places,
            cells,
            scale,
        })
    }

    /// Returns the cell at a place for some choices, by variable.
    pub(in crate::score) fn cell_at(&self, choices: &[usize], place: &PlacedJoint) -> &Cell {
        &self.cells[place.variable][choices[place.variable]][place.slot]
    }

    /// Returns the number of unknowns of the equations: wrenches of the contours, then loads of the couplings.
    pub(in crate::score) fn count_unknowns(&self) -> usize {
        self.basis.len() * self.contours + self.couplings
    }

    /// Writes an equation of a place over the unknowns, and then its right sides, to zeros.
    pub(in crate::score) fn write_row(&self, place: &PlacedJoint, row: &[f64], out: &mut [f64]) {
        let dim = self.basis.len();
        for &(k, sign) in &place.contours {
            for (o, x) in out[k * dim..(k + 1) * dim].iter_mut().zip(row) {
                *o = sign * x;
            }
        }
        out[dim * self.contours..].copy_from_slice(&row[dim..]);
    }

    /// Returns an equation of a place over the unknowns, and then its right sides.
    pub(in crate::score) fn whole_row(&self, place: &PlacedJoint, row: &[f64]) -> Vec<f64> {
        let mut out = vec![0.0; self.count_unknowns() + self.cases];
        self.write_row(place, row, &mut out);
        out
    }

    /// Adds the outer products of the equations of a place to those of all, unknowns × unknowns; the upper triangle is enough.
    pub(in crate::score) fn add_gram(&self, place: &PlacedJoint, cell: &Cell, gram: &mut [f64]) {
        let (dim, unknowns) = (self.basis.len(), self.count_unknowns());
        let (width, first) = (dim + self.couplings, dim * self.contours);
        for &(k, s) in &place.contours {
            for a in 0..dim {
                let row = (k * dim + a) * unknowns;
                let own = &cell.gram[a * width..(a + 1) * width];
                for &(l, t) in place.contours.iter().filter(|(l, _)| *l >= k) {
                    let from = row + l * dim;
                    for (o, g) in gram[from..from + dim].iter_mut().zip(own) {
                        *o += s * t * g;
                    }
                }
                for (o, g) in gram[row + first..row + unknowns]
                    .iter_mut()
                    .zip(&own[dim..])
                {
                    *o += s * g;
                }
            }
        }
        for q in 0..self.couplings {
            let row = (first + q) * unknowns + first;
            let own = &cell.gram[(dim + q) * width + dim..(dim + q + 1) * width];
            for (o, g) in gram[row..row + self.couplings].iter_mut().zip(own) {
                *o += g;
            }
        }
    }

    /// Returns the wrench that a place's joint bears in a load case, for the unknowns `x`, unknowns × cases. The teeth of
    /// the couplings in `meshing` mesh.
    pub(in crate::score) fn wrench_at(
        &self,
        place: &PlacedJoint,
        case: usize,
        x: &[f64],
        meshing: &[bool],
    ) -> Six {
        let dim = self.basis.len();
        let mut w = place.along_tree[case];
        for &(k, sign) in &place.contours {
            for (b, i) in self.basis.iter().zip(k * dim..) {
                let x = sign * x[i * self.cases + case];
                for (w, b) in w.iter_mut().zip(b) {
                    *w += x * b;
                }
            }
        }
        for at in &place.couplings {
            let x = x[(dim * self.contours + at.coupling) * self.cases + case];
            let beside = &at.beside[usize::from(meshing[at.coupling])];
            w.iter_mut().zip(beside).for_each(|(w, b)| *w -= x * b);
        }
        w
    }

    /// Returns the force `[N]` and moment about the place `[N·m]` of a wrench, without the part that a drive bears.
    pub(in crate::score) fn borne_at(
        &self,
        place: &PlacedJoint,
        wrench: &Six,
    ) -> ([f64; 3], [f64; 3]) {
        let w = shift_wrench(wrench, place.point);
        let (mut f, mut m) = ([w[3], w[4], w[5]], [w[0], w[1], w[2]]);
        if let Some((axis, shift)) = place.held {
            if shift {
                f = across(f, axis);
            } else {
                m = across(m, axis);
            }
        }
        (f, m.map(|x| x * self.size))
    }
}

fn cell_at<'o>(
    m: &Mechanism,
    geometry: &Geometry,
    pose: &Pose,
    types: &JointTypes,
    drives: &[Driven],
    place: &PlacedJoint,
    series: impl Iterator<Item = (&'o JointOption, bool)>,
) -> Result<Cell, Unsolved> {
    let width = geometry.basis.len() + geometry.couplings.len();
    let mut out = Cell {
        rows: Vec::new(),
        gram: vec![0.0; width * width],
        bears: Vec::new(),
        clearance: 0.0,
        coupled: Vec::new(),
    };
    for (option, present) in series {
        let t = types.option_type(option);
        out.bears.push((t.capacity_force, t.capacity_moment));
        out.clearance += t.clearance;
        let twists: Vec<(Freedom, Six)> = if present {
            let own = geometry.columns.iter().filter(|c| c.joint == place.joint);
            own.map(|c| (c.freedom, c.twist)).collect()
        } else {
            option_twists(m, geometry, pose, place, option)?
        };
        let first = out.bears.len() == 1;
        out.coupled = coupled_choice(geometry, place, &twists, first);
        for (freedom, twist) in twists {
            if first && drives.contains(&(place.joint, freedom)) {
                continue;
            }
            let mut own: Vec<f64> = geometry
                .basis
                .iter()
                .map(|b| wrench_power(b, &twist))
                .collect();
            own.resize(width, 0.0);
            if first {
                let joint = place.joint;
                let column = FreedomColumn {
                    joint,
                    freedom,
                    twist,
                };
                for (q, e) in geometry.coupling_entries(&column) {
                    own[geometry.basis.len() + q] = e;
                }
            }
            for a in 0..width {
                for b in 0..width {
                    out.gram[a * width + b] += own[a] * own[b];
                }
            }
            let right = place.along_tree.iter().map(|w| -wrench_power(&twist, w));
            out.rows.push(own.iter().copied().chain(right).collect());
        }
    }
    Ok(out)
}

/// Returns the effect of an option with these freedoms on the couplings at its place, as the first in series or as a later one.
fn coupled_choice(
    geometry: &Geometry,
    place: &PlacedJoint,
    twists: &[(Freedom, Six)],
    first: bool,
) -> Vec<CoupledChoice> {
    let one = |at: &PlacedCoupling| {
        let equation = &geometry.couplings[at.coupling];
        let tied = equation.ends[at.end].freedom;
        let others = twists.iter().filter(|(f, _)| *f != tied);
        if !first {
            CoupledChoice::InSeries
        } else if equation.is_borne(at.end, others.map(|(_, t)| t)) {
            CoupledChoice::BearsTeeth
        } else {
            CoupledChoice::AlongFreedom
        }
    };
    place.couplings.iter().map(one).collect()
}

/// Returns the unit twists of an option at a pose of the original mechanism. Freedoms before the original turn (slides,
/// except that of a slot) move with the joint's first link, later ones with the second.
fn option_twists(
    m: &Mechanism,
    geometry: &Geometry,
    pose: &Pose,
    place: &PlacedJoint,
    option: &JointOption,
) -> Result<Vec<(Freedom, Six)>, Unsolved> {
    let space = MotionSpace::new(&Reals, &m.mode)?;
    let joint = &m.joints[place.joint];
    let frame = FrameValues::new(&Reals, &option.frame)?;
    // Turns and slides at the joint's own point.
    let here = FrameValues {
        axes: frame.axes.map(unit),
        point: [0.0; 3],
        pitch: frame.pitch * geometry.metres / geometry.size,
    };
    let present = joint.joint_type.freedoms();
    let mut second = false;
    let mut out = Vec::new();
    // As the joint built has them: the slide of a slot comes after its pin.
    let motions = here.motions_in_series(&Reals, &space, option.joint_type.freedoms());
    for (freedom, motion) in motions {
        let link = joint.links[usize::from(second)];
        second |= present.contains(&freedom);
        let carried = &pose.links[link];
        let point = geometry.point_position(pose, link, frame.point);
        let [a, b, c, d, e, f] = unit_twist(motion);
        let (turn, slide) = (
            carried.map_direction([a, b, c]),
            carried.map_direction([d, e, f]),
        );
        let arm = cross(point, turn);
        let at = |i: usize| arm[i] + slide[i];
        out.push((freedom, [turn[0], turn[1], turn[2], at(0), at(1), at(2)]));
    }
    Ok(out)
}

#[cfg(test)]
mod tests;
