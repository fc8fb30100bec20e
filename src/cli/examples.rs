//! Examples for the help of each command. Two spaces separate a command from its description; a test runs every line.

pub(super) const MAIN: &str = "\
Examples:
  ozols list                                   the built-in mechanisms
  ozols analyze gripper-10                     mobility and redundant constraints, loop by loop
  ozols search gripper-10                      the best statically determinate redesigns
  ozols new mine.toml --from four-bar          a commented file to start from
  ozols check mine.toml                        a summary, errors and warnings
  ozols explain sigma                          what a term means; without a term, the list
  ozols statics parallel-shears                Assur groups, and joint reactions over the cycle
  ozols grip lever-gripper                     what its levers can hold, and the drive moment
  ozols drive torsion-module                   the torsion bar, the cam spring, and the programme run
  ozols draw gripper-10 -o gripper.svg         a drawing of it
  ozols export robot.urdf --to toml -o robot.toml    convert a robot description to a mechanism file
Each command has its own help: `ozols search --help`.

Exit codes: 0 done; 1 nothing found, a certificate rejected or a stroke not finished; 2 bad input or failure;
130, 143 or 129 interrupted by Ctrl-C, SIGTERM or SIGHUP.";

pub(super) const ANALYZE: &str = "\
Examples:
  ozols analyze gripper-10                         every state, loop by loop
  ozols analyze gripper-10 --state free            one state
  ozols analyze bennett --method count             the result of a counting formula
  ozols analyze four-bar --stroke 0:360deg:12      also the poses over a turn of its crank
  ozols analyze four-bar --format json -o four-bar.json
  ozols analyze four-bar --certificate proof.json  a proof of the rank, for `ozols verify`";

pub(super) const SEARCH: &str = "\
Examples:
  ozols search gripper-10                               the ten cheapest statically determinate redesigns
  ozols search gripper-10 --max-mobility 1 --top 3      only those without idle links
  ozols search gripper-10 --options revolute,spherical  only with these joint types
  ozols search gripper-10 --allow 2-3=spherical --forbid 3-0
  ozols search gripper-10 --count --max-redundant 1     how many keep at most one redundant constraint
  ozols search gripper-10 --max-external 2 --top 3      includes the contacts with the clamped part
  ozols search gripper-10-loaded --top 3 --pool 50      ranked under the workload
  ozols search four-bar --all --format csv -o all.csv   all of them, as a table";

pub(super) const STATICS: &str = "\
Examples:
  ozols statics parallel-shears                          groups and reactions over the file's stroke
  ozols statics parallel-shears --stroke 0:360deg:12 --svg charts
  ozols statics gripper-10-loaded --spatial              six components per joint, and those left undetermined
  ozols statics parallel-shears --groups                 Assur groups under each possible drive
  ozols statics --stability -o stability                 accuracy of the methods near their failures";

pub(super) const GRIP: &str = "\
Examples:
  ozols grip lever-gripper                           contact forces and drive moment for all diameters
  ozols grip lever-gripper --acceleration 5,0,-2     with an additional acceleration of the gripper
  ozols grip lever-gripper --any-acceleration 3      in any direction; `ozols drive` prints a value
  ozols grip lever-gripper --svg charts              charts of the force arms and the drive moment";

pub(super) const DRIVE: &str = "\
Examples:
  ozols drive torsion-module                         sizes of the bar and the cam spring, and the programme run
  ozols drive torsion-module --svg charts            the same with charts
  ozols drive torsion-module --format json -o drive.json";

pub(super) const VERIFY: &str = "\
Examples:
  ozols analyze four-bar --certificate proof.json  write the proof
  ozols verify four-bar proof.json                 check it: exit code 0 confirmed, 1 rejected";

pub(super) const LINT: &str = "\
Examples:
  ozols lint robot.urdf                                redundant constraints: exit code 0 none, 1 some
  ozols lint robot.urdf --format json                  the same for programs";

pub(super) const FIX: &str = "\
Examples:
  ozols fix robot.urdf -o fixed.urdf                   the cheapest releases that remove all, adding no motion
  ozols fix robot.urdf --at elbow -o fixed.urdf        only at these joints
  ozols fix robot.urdf --variant 2 -o fixed.urdf       the second redesign that `ozols search` lists";

pub(super) const DRAW: &str = "\
Examples:
  ozols draw gripper-10 --kind scheme -o gripper.svg     structural scheme
  ozols draw bennett -o bennett.svg                       kinematic scheme
  ozols draw gripper-10 --motion -o moving.svg           the same, moving
  ozols draw gripper-10 --state clamped -o clamped.svg   with the clamped part
  ozols draw gripper-10 --variant 1 -o first.svg         the best redesign, its changes in colour";

pub(super) const REPORT: &str = "\
Examples:
  ozols report gripper-10 -o report.html                     one page for the browser, no network needed
  ozols report gripper-10 --max-mobility 1 -o report.html    only redesigns without idle links
  ozols report gripper-10-loaded -o report.html              ranked under its workload, with joint loads";

pub(super) const STUDIO: &str = "\
Everything stays on this machine: the page is served only to this machine, at an address with a token.

Examples:
  ozols studio                                       an empty sheet
  ozols studio gripper-10                            a copy of a built-in mechanism
  ozols studio mine.toml                             your own file; changes keep its comments
  ozols studio mine.toml --no-open                   print the address, for a browser of your choice";

pub(super) const EXPORT: &str = "\
Examples:
  ozols export gripper-10 --to json -o gripper.json      the mechanism file as JSON
  ozols export gripper-10 --to sdf -o gripper.sdf        a robot description with its loops
  ozols export gripper-10 --to dot                       its graph for Graphviz
  ozols export gripper-10 --variant 1 --to toml -o v.toml          the first redesign as a separate mechanism file
  ozols export gripper-10 --variant 3 --max-mobility 1 --to sdf    the third of those without idle links
  ozols export robot.urdf --to toml -o robot.toml                  standard error lists what was mapped and dropped
  ozols export robot.urdf --loops loops.yaml --to toml -o closed.toml    the loops come from a separate file
  ozols export robot.urdf --working-link effector --to json";

pub(super) const ACCURACY: &str = "\
Examples:
  ozols accuracy --quick                             only the table
  ozols accuracy --quick -o accuracy                 with charts and a page: open accuracy/index.html
  ozols accuracy -o accuracy                         the same with more repeats: some minutes";

pub(super) const BENCH: &str = "\
Examples:
  ozols bench --quick lever-gripper                  every search method, including pools of its ranking
  ozols bench --quick four-bar --max-mobility 1      under the conditions of ozols search
  ozols bench --quick four-bar -o bench              with charts and a page: open bench/index.html";

pub(super) const CATALOG: &str = "\
Examples:
  ozols catalog count                                chains and grippers of 4, 6 and 8 links
  ozols catalog count --links 10 --format json       those of ten links, for programs
  ozols catalog chains --links 6                     the chains of Watt and Stephenson
  ozols catalog chains --links 7 --mobility 2        those with two inputs";

pub(super) const CHECK: &str = "\
Warnings do not affect the exit code; only a file that cannot be used ends with exit code 2.

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
  ozols show gripper-10 > mine.toml                  unchanged; `ozols new` adds comments to every key";

pub(super) const SCHEMA: &str = "\
Examples:
  ozols schema > mechanism.schema.json               for editors that complete and check TOML or JSON by a schema";

pub(super) const NEW: &str = "\
Examples:
  ozols new mine.toml                                a four-bar
  ozols new gripper.toml --from gripper-10           another built-in mechanism, see `ozols list`
  ozols new gripper.toml --from tongs --force        replaces an existing file
  ozols check gripper.toml";

pub(super) const EXPLAIN: &str = "\
Examples:
  ozols explain                                      all terms in one table
  ozols explain sigma                                one term; σ works, too
  ozols explain redundant constraint                 terms may have several words";

pub(super) const COMPLETIONS: &str = "\
Location of the script: bash, ~/.local/share/bash-completion/completions/ozols; zsh, _ozols in a folder of $fpath; fish,
~/.config/fish/completions/ozols.fish; elvish and powershell, the end of the profile.

Examples:
  ozols completions bash > ozols.bash                then: source ozols.bash
  ozols completions zsh > _ozols
  ozols completions fish > ozols.fish";

/// The output of `ozols` without arguments.
pub(super) const FIRST: &str = "\
ozols finds the redundant constraints of a mechanism, and every redesign that removes them.

  ozols list                  the built-in mechanisms
  ozols analyze gripper-10    the redundant constraints of one of them
  ozols search gripper-10     the best redesigns
  ozols new mine.toml         a commented file to edit; then ozols mine.toml opens it
  ozols explain sigma         what a term in the output means
  ozols --help                every command
";
