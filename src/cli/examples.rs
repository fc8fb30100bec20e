//! Examples for the help of each command. Two blanks stand between a command and what it does; a test runs every line.

pub(super) const MAIN: &str = "\
Examples:
  ozols list                                   the built-in mechanisms
  ozols analyze gripper-10                     mobility and redundant constraints, contour by contour
  ozols search gripper-10                      the best statically determinate redesigns
  ozols new mine.toml --from four-bar          a commented file of your own to start from
  ozols check mine.toml                        what it describes, and what is wrong with it, if anything
  ozols explain sigma                          what a word means; without a word, all of them
  ozols statics parallel-shears                Assur groups, and joint reactions over the cycle
  ozols grip lever-gripper                     what its levers can hold, and with what drive moment
  ozols drive torsion-module                   the torsion bar, the cam spring, and the programme run
  ozols draw gripper-10 -o gripper.svg         its structural scheme
  ozols export robot.urdf --to toml -o robot.toml    a mechanism file of a robot description
Each command has its own: `ozols search --help`.

Exit codes: 0 done; 1 nothing found, a certificate rejected or a stroke not finished; 2 bad input or failure;
130, 143 or 129 interrupted by Ctrl-C, SIGTERM or SIGHUP.";

pub(super) const ANALYZE: &str = "\
Examples:
  ozols analyze gripper-10                         every state, contour by contour
  ozols analyze gripper-10 --state free            one state
  ozols analyze bennett --method count             what a counting formula says
  ozols analyze four-bar --stroke 0:360deg:12      and in the poses over a turn of its crank
  ozols analyze four-bar --format json -o four-bar.json
  ozols analyze four-bar --certificate proof.json  a proof of the rank, for `ozols verify`";

pub(super) const SEARCH: &str = "\
Examples:
  ozols search gripper-10                               the ten cheapest statically determinate redesigns
  ozols search gripper-10 --max-mobility 1 --top 3      only those without idle links
  ozols search gripper-10 --options revolute,spherical  with these joints alone
  ozols search gripper-10 --allow 2-3=spherical --forbid 3-0
  ozols search gripper-10 --count --max-redundant 1     how many there are with one redundant constraint left
  ozols search gripper-10 --max-external 2 --top 3      the contacts with the clamped part searched along
  ozols search gripper-10-loaded --top 3 --pool 50      ranked under the workload
  ozols search four-bar --all --format csv -o all.csv   every one, as a table";

pub(super) const STATICS: &str = "\
Examples:
  ozols statics parallel-shears                          groups and reactions over the file's stroke
  ozols statics parallel-shears --stroke 0:360deg:12 --svg charts
  ozols statics gripper-10-loaded --spatial              six components a joint, and what redundancy leaves open
  ozols statics parallel-shears --groups                 Assur groups under each possible drive
  ozols statics --stability -o stability                 accuracy of the methods near their failures";

pub(super) const GRIP: &str = "\
Examples:
  ozols grip lever-gripper                           contact forces and drive moment over its range of diameters
  ozols grip lever-gripper --acceleration 5,0,-2     with one more acceleration of the gripper
  ozols grip lever-gripper --any-acceleration 3      with one in any direction, such as `ozols drive` prints
  ozols grip lever-gripper --svg charts              charts of the force arms and the drive moment
  ozols grip gripper-10-loaded --closure             force closure and form closure of any clamped mechanism";

pub(super) const DRIVE: &str = "\
Examples:
  ozols drive torsion-module                         sizes of the bar and the cam spring, and the programme run
  ozols drive torsion-module --svg charts            the same with charts
  ozols drive torsion-module --format json -o drive.json";

pub(super) const VERIFY: &str = "\
Examples:
  ozols analyze four-bar --certificate proof.json  writes the proof
  ozols verify four-bar proof.json                 confirms it: 0 confirmed, 1 rejected";

pub(super) const LINT: &str = "\
Examples:
  ozols lint robot.urdf                                what its loops hold twice: exit code 0 nothing, 1 something
  ozols lint robot.urdf --format json                  the same for programs";

pub(super) const FIX: &str = "\
Examples:
  ozols fix robot.urdf -o fixed.urdf                   the cheapest releases that remove all and let nothing move
  ozols fix robot.urdf --at elbow -o fixed.urdf        at these joints alone
  ozols fix robot.urdf --variant 2 -o fixed.urdf       the second redesign that `ozols search` lists";

pub(super) const DRAW: &str = "\
Examples:
  ozols draw gripper-10 -o gripper.svg                   structural scheme
  ozols draw bennett --kind kinematic -o bennett.svg     kinematic scheme
  ozols draw gripper-10 --motion -o moving.svg           the same, moving
  ozols draw gripper-10 --state clamped -o clamped.svg   with the part it holds
  ozols draw gripper-10 --variant 1 -o first.svg         the best redesign, its changes in colour";

pub(super) const REPORT: &str = "\
Examples:
  ozols report gripper-10 -o report.html                     one page for the browser, no network needed
  ozols report gripper-10 --max-mobility 1 -o report.html    only redesigns without idle links
  ozols report gripper-10-loaded -o report.html              ranked under its workload, with the joints' loads";

pub(super) const STUDIO: &str = "\
Everything stays on this machine: the page is served to this machine alone, at an address with a token.

Examples:
  ozols studio                                       an empty sheet
  ozols studio gripper-10                            a copy of a built-in mechanism
  ozols studio mine.toml                             a file of your own; every change edits it, comments kept
  ozols studio mine.toml --no-open                   prints the address, for a browser of your choice";

pub(super) const EXPORT: &str = "\
Examples:
  ozols export gripper-10 --to json -o gripper.json      the mechanism file as JSON
  ozols export gripper-10 --to sdf -o gripper.sdf        a robot description, loops and all
  ozols export gripper-10 --to dot                       its graph for Graphviz
  ozols export gripper-10 --variant 1 --to toml -o v.toml          the first redesign, a mechanism file of its own
  ozols export gripper-10 --variant 3 --max-mobility 1 --to sdf    the third of those without idle links
  ozols export robot.urdf --to toml -o robot.toml                  what was mapped and dropped is said on standard error
  ozols export robot.urdf --loops loops.yaml --to toml -o closed.toml    loops of a tree come from a file beside it
  ozols export robot.urdf --working-link effector --to json";

pub(super) const ACCURACY: &str = "\
Examples:
  ozols accuracy --quick                             the table alone
  ozols accuracy --quick -o accuracy                 with charts and a page: open accuracy/index.html
  ozols accuracy -o accuracy                         the same with more repeats: a minute or two";

pub(super) const BENCH: &str = "\
Examples:
  ozols bench --quick lever-gripper                  every way of searching, pools of its ranking among them
  ozols bench --quick four-bar --max-mobility 1      under the conditions of ozols search
  ozols bench --quick four-bar -o bench              with charts and a page: open bench/index.html";

pub(super) const CATALOG: &str = "\
Examples:
  ozols catalog count                                chains and grippers of 4, 6 and 8 links
  ozols catalog count --links 10 --format json       those of ten links, for programs
  ozols catalog chains --links 6                     the chains of Watt and Stephenson
  ozols catalog chains --links 7 --mobility 2        those with two inputs";

pub(super) const CHECK: &str = "\
Warnings are no failure; only a file that cannot be used ends with exit code 2.

Examples:
  ozols new mine.toml                                a file to try it on
  ozols check mine.toml
  ozols check gripper-10                             a built-in mechanism";

pub(super) const LIST: &str = "\
Examples:
  ozols list                                         all of them, by family
  ozols list bennett                                 those whose name, family or description has the word
  ozols list parallel robot                          those that have both words";

pub(super) const SHOW: &str = "\
Examples:
  ozols show gripper-10                              its file
  ozols show gripper-10 > mine.toml                  as it is; `ozols new` adds comments to every key";

pub(super) const SCHEMA: &str = "\
Examples:
  ozols schema > mechanism.schema.json               for editors that complete and check TOML or JSON by a schema";

pub(super) const NEW: &str = "\
Examples:
  ozols new mine.toml                                a four-bar
  ozols new gripper.toml --from gripper-10           another built-in mechanism, see `ozols list`
  ozols new gripper.toml --from tongs --force        in place of the file that is there
  ozols check gripper.toml";

pub(super) const EXPLAIN: &str = "\
Examples:
  ozols explain                                      every term in one table
  ozols explain sigma                                one of them; σ does as well
  ozols explain redundant constraint                 terms may have several words";

pub(super) const COMPLETIONS: &str = "\
Where the script goes: bash, ~/.local/share/bash-completion/completions/ozols; zsh, _ozols in a folder of $fpath; fish,
~/.config/fish/completions/ozols.fish; elvish and powershell, the end of the profile.

Examples:
  ozols completions bash > ozols.bash                then: source ozols.bash
  ozols completions zsh > _ozols
  ozols completions fish > ozols.fish";

/// What `ozols` alone says.
pub(super) const FIRST: &str = "\
ozols finds the redundant constraints of a mechanism, and every redesign that removes them.

  ozols list                  the mechanisms it knows
  ozols analyze gripper-10    what is redundant in one of them, and where
  ozols search gripper-10     the best redesigns
  ozols new mine.toml         a commented file of your own; then ozols check mine.toml
  ozols explain sigma         what a word in the answers means
  ozols --help                every command
";
