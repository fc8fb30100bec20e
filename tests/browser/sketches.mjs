// Sketches of machines as engineers draw them, with the mistakes that they have: text of mechanism files.

/** A file of rows: links with a star for an output, and joints as "id, links, type, point, axis, more". */
function sketch(name, links, rows, search) {
  const link = (word, n) => `[[link]]\nid = "${word.replace("*", "")}"\n${n === 0 ? 'role = "frame"\n' : word.endsWith("*") ? 'role = "output"\n' : ""}`;
  const joint = (row) => {
    const [id, ends, type, point, axis, more] = row.split("|").map((cell) => cell.trim());
    const own = type === "helical" ? "lead = 5\n" : "";
    const [a, b] = ends.split(" ");
    return `[[joint]]\nid = "${id}"\nlinks = ["${a}", "${b}"]\ntype = "${type}"\npoint = [${point}]\n${axis ? `axis = [${axis}]\n` : ""}${own}${more ? `${more}\n` : ""}`;
  };
  return [`name = "${name}"\nlength_unit = "mm"\n`, ...links.split(" ").map(link), ...rows.trim().split("\n").map(joint), `[search]\noptions = [${search.map((w) => `"${w}"`).join(", ")}]\n`].join("\n");
}

const HINGES = ["revolute", "cylindrical", "universal", "spherical"];
/** Options of a bolt, as its joint has them. */
const BOLT = 'options = ["fixed", "revolute", "spherical", "prismatic", "planar", "cylindrical"]';

/** By name, the text. */
export const SKETCHES = {
  "screw-gripper": sketch("screw-gripper", "body screw nut link-l link-r jaw-l* jaw-r*", `
    motor | body screw | revolute | 0, 0, 0 | 0, 1, 0 | drive = true
    thread | screw nut | helical | 0, 20, 0 | 0, 1, 0
    nut-guide | nut body | prismatic | 0, 20, 10 | 0, 1, 0
    A | nut link-l | revolute | -10, 20, 0 | 0, 0, 1
    B | link-l jaw-l | revolute | -30, 50, 0 | 0, 0, 1
    rail-l | jaw-l body | prismatic | -30, 60, 0 | 1, 0, 0
    C | nut link-r | revolute | 10, 20, 0 | 0, 0, 1
    D | link-r jaw-r | revolute | 30, 50, 0 | 0, 0, 1
    rail-r | jaw-r body | prismatic | 30, 60, 0 | 1, 0, 0`, ["revolute", "cylindrical", "spherical", "prismatic"]),
  "bed-on-three-balls": sketch("bed-on-three-balls", "frame bed* n1 n2 n3", `
    z1 | frame n1 | prismatic | 0, 0, 0 | 0, 0, 1 | drive = true
    z2 | frame n2 | prismatic | 240, 0, 0 | 0, 0, 1 | drive = true
    z3 | frame n3 | prismatic | 90, 210, 0 | 0, 0, 1 | drive = true
    b1 | n1 bed | spherical | 0, 0, 12
    b2 | n2 bed | spherical | 240, 0, 12
    b3 | n3 bed | spherical | 90, 210, 12`, ["spherical", "sphere-in-cylinder", "sphere-on-plane"]),
  "printer-bed": sketch("printer-bed", "frame bed* s1 s2 s3", `
    m1 | frame s1 | revolute | 150, 0, 0 | 0, 0, 1 | drive = true
    m2 | frame s2 | revolute | "-75", "75*sqrt(3)", 0 | 0, 0, 1 | drive = true
    m3 | frame s3 | revolute | "-75", "-75*sqrt(3)", 0 | 0, 0, 1 | drive = true
    n1 | s1 bed | helical | 150, 0, 100 | 0, 0, 1
    n2 | s2 bed | helical | "-75", "75*sqrt(3)", 100 | 0, 0, 1
    n3 | s3 bed | helical | "-75", "-75*sqrt(3)", 100 | 0, 0, 1`, ["cylindrical", "spherical", "universal", "planar"]),
  gantry: sketch("gantry", "bed bridge* carriage-l carriage-r screw-l screw-r", `
    rail-l | bed carriage-l | prismatic | -400, 0, 0 | 0, 1, 0
    rail-r | bed carriage-r | prismatic | 400, 0, 0 | 0, 1, 0
    bolt-l | carriage-l bridge | fixed | -400, 0, 30 | | ${BOLT}
    bolt-r | carriage-r bridge | fixed | 400, 0, 30 | | ${BOLT}
    motor-l | bed screw-l | revolute | -400, -300, 50 | 0, 1, 0 | drive = true
    nut-l | screw-l carriage-l | helical | -400, 0, 50 | 0, 1, 0
    motor-r | bed screw-r | revolute | 400, -300, 50 | 0, 1, 0 | drive = true
    nut-r | screw-r carriage-r | helical | 400, 0, 50 | 0, 1, 0`, ["prismatic", "cylindrical", "revolute", "spherical", "universal"]),
  "double-wishbone": sketch("double-wishbone", "chassis lower upper upright* tie-rod damper-body damper-rod", `
    lower-front | chassis lower | revolute | 150, 300, 150 | 1, 0, 0
    lower-rear | chassis lower | revolute | -150, 300, 150 | 1, 0, 0
    upper-front | chassis upper | revolute | 120, 380, 400 | 1, 0, 0
    upper-rear | chassis upper | revolute | -120, 380, 400 | 1, 0, 0
    lower-ball | lower upright | spherical | 10, 680, 140
    upper-ball | upper upright | spherical | -10, 640, 410
    tie-in | chassis tie-rod | spherical | -120, 330, 200
    tie-out | tie-rod upright | spherical | -130, 670, 195
    damper-top | chassis damper-body | revolute | 0, 350, 600 | 1, 0, 0
    damper | damper-body damper-rod | cylindrical | 0, 450, 375 | 0, 200, -450 | drive = true
    damper-foot | damper-rod lower | revolute | 0, 550, 150 | 1, 0, 0`, HINGES),
  "screw-jack": sketch("screw-jack", "base screw table*", `
    motor | base screw | revolute | 0, 0, 0 | 0, 0, 1 | drive = true
    nut | screw table | helical | 0, 0, 50 | 0, 0, 1
    rail | table base | prismatic | 40, 0, 50 | 0, 0, 1`, HINGES),
  "hand-one-pin": sketch("hand-one-pin", "0 1 2 3 4* 5*", `
    0-1 | 0 1 | prismatic | -60, 0, 0 | 1, 0, 0 | drive = true
    1-2 | 1 2 | revolute | -60, 0, 0 | 0, 0, 1
    1-3 | 1 3 | revolute | -60, 0, 0 | 0, 0, 1
    2-4 | 2 4 | revolute | -30, 30, 0 | 0, 0, 1
    3-5 | 3 5 | revolute | -30, -30, 0 | 0, 0, 1
    0-4 | 0 4 | revolute | 0, 20, 0 | 0, 0, 1
    0-5 | 0 5 | revolute | 0, -20, 0 | 0, 0, 1`, HINGES),
};
