"""Refusals of the command line: each line that raises one is reached, and names the fault."""

import ast
import re
import signal
from pathlib import Path
from traceback import walk_tb
from typing import Any

import click
import pytest

from atlas import cli
from atlas.cli import points
from atlas.cli.app import atlas as command
from atlas.cli.app import main
from atlas.errors import AtlasError
from atlas.fitting import data

BODY = "--ratio 1.5 --field 1 2"
SQUARE = [(1, 0), (-1, 0), (0, 1), (0, -1)]
FILES: dict[str, str | bytes] = {
    "one.csv": "t,R11\n0,1\n",
    "plain.csv": "x,y,z,mass\n" + "".join(f"{x},{y},1,1\n" for x, y in SQUARE),
    "charged.csv": "x,y,z,mass,charge\n" + "".join(f"{x},{y},1,1,1\n" for x, y in SQUARE),
    "uneven.csv": "x,y,z,mass,charge\n" + "".join(f"{x},{y},1,1,{2 + x}\n" for x, y in SQUARE),
    "skew.csv": "x,y,z,mass\n1,0,0,1\n-1,0,0,1\n0,1,0,2\n0,-1,0,2\n",
    "leaning.csv": "x,y,z,mass\n1,0,1,1\n-1,0,-1,1\n0,1.5,0,1\n0,-1.5,0,1\n",
    "extra.csv": "x,y,z,mass,spin\n1,0,0,1,1\n",
    "bytes.csv": b"t,\xff\n1,2\n",
    "nul.csv": 't,x\n1,"' + "9" * 131_073 + '"\n',
    "twice.csv": "t,t\n1,2\n",
    "bare.csv": "t,x\n",
    "short.csv": "t,x\n\n1,2\n\n3\n",
    "word.csv": "t,x\n1,2\n\n3,two\n",
    "ratios.csv": "ratio\n0.5\n",
    "cone.csv": "mine",
    "words.csv": "t,x\n1,two\n",
    "holes.csv": "t,x\n0,\n1,nan\n",
    "empty.csv": "ratio,omega2\n",
    "again.csv": "ratio,ratio\n1,2\n",
    "long.csv": "ratio\n1,2\n",
    "other.csv": "ratio,spicy\n1,2\n",
    "bad.toml": "family =\n",
    "parts.csv": "t,q0\n0,1\n",
    "oblique.csv": "x,y,z,mass\n1,.2,0,1\n-1,-.2,0,1\n0,1,.3,2\n0,-1,-.3,2\n.1,0,1,1\n-.1,0,-1,1\n",
    "letters.csv": "t,Omega1,Omega2,Omega3\n0,1,0,x\n",
    "partly.csv": "t,Omega1\n" + "0,1\n" * 9,
    "still.csv": "t,Omega1,Omega2,Omega3\n" + "0,1,0,0\n" * 9,
    "one.py": "",
    "sub/one.py": "",
}
SWEEP = "sweep elementary --quantity k --out {place}/out.csv"
GAMMA = "sweep ball --quantity gamma --out {place}/out.csv"
TOP = "top --direction 1 2 --omega 1 2 3"
DISK = "top --shape disk --radius 0.03 --mass 0.1 --heavy 9.81 0.04 --direction 0.3 1 --omega 0 0 150"
CHARGED = "top --inertia 2e-27 1e-27 --charged 1e-23 2e-23 --magnetic 1 2 --omega 0.1 0.2 0.3"
OVER = "animate cone --out {place}/new --over"
MASS, SI = "--mass 1", "--magnetic 1 2 --mu 1"
CASES = [
    ("report your_body", "your_body takes a body, a field and a start"),
    ("plot {place}/ratios.csv ratio ratoi", "'ratio'"),
    ("plot {place}/ratios.csv ratio ratio --out a.gif", "the ending is .pdf, .svg or .png, not .gif"),
    ("plot {place}/bare.csv t x", "at least one row"),
    ("plot {place}/long.csv ratio ratio", "line 2: 2 cells where the line of names has 1"),
    ("plot {place}/words.csv t x", "the column x has text"),
    ("plot {place}/holes.csv t x", "no row with numbers in both t and x"),
    ("report your_body --from nobody", "'nobody'"),
    ("report your_body --only cart --ratio 0.7 --field 1 2", "no part 'cart' of the report (did you mean 'card'?)"),
    ("report your_body --each {place}/empty.csv", "a heading of different names, as ratio,radius [um]"),
    ("report your_body --each {place}/again.csv", "a heading of different names"),
    ("report your_body --each {place}/long.csv", "line 2: 2 cells where the line of names has 1"),
    ("report your_body --each {place}/other.csv", "'spicy'"),
    ("classify --field 1 2", "the body is missing: give one of --ratio"),
    ("classify --ratio 1 --inertia 1 1 --field 1 2", "by --ratio and --inertia"),
    ("classify --ratio 1 --radius 1 --field 1 2", "--radius goes with --shape only"),
    ("classify --shape thin-rod --height 1 --field 1 2", "a thin rod has I3 = 0"),
    ("classify --shape cube --field 1 2", "there is no shape 'cube'; the shapes are "),
    ("classify --shape ring --field 1 2", "the shape ring takes --radius; found none."),
    ("classify --shape ring --radius 1 --height 2 --field 1 2", "takes --radius; found --radius --height."),
    ("classify --shape ring --radius 1e-150 --field 1 2", "--radius 1e-150 has a square beyond"),
    ("classify --shape ring --radius 1e150 --field 1 2", "--radius 1e150 has a square beyond"),
    ("classify --points {place}/ratios.csv --field 1 2", "must have the columns x, y, z, mass"),
    ("classify --points {place}/extra.csv --field 1 2", "it has x, y, z, mass, spin"),
    ("classify --points {place}/skew.csv --field 1 2", "z: I1 = I2 would be needed"),
    ("classify --points {place}/leaning.csv --field 1 2", "I1 = I2 and no products would be needed"),
    ("classify --points {place}/uneven.csv --magnetic 1 2", "goes from 1 to 3"),
    ("classify --points {place}/plain.csv --field 1 2 --decimal --digits 30", "not with --points"),
    ("classify --points {place}/charged.csv --magnetic 1 2 --charge 1", "leave out --charge"),
    ("classify --points {place}/charged.csv --magnetic 1 2 --mu 1", "leave out --mu"),
    ("classify --points {place}/plain.csv --magnetic 1 2", "has no column charge"),
    ("classify --ratio 1 --magnetic 1 2 --mu 1 --mass 1", "leave out --mass"),
    ("classify --ratio 1 --magnetic 1 2", "needs --mass and --charge, or --mu,"),
    ("classify --ratio 1 --magnetic 1 2 --mass 1", "needs --charge,"),
    ("classify --ratio 1 --magnetic 1 2 --charge 1", "needs --mass,"),
    ("classify --ratio 1", "the field is missing: give B' by --field"),
    ("classify --ratio 1 --field 1 2 --magnetic 1 2", "the field is given twice"),
    *((f"classify {BODY} --{option}", f"--{option.split()[0]} goes with --magnetic only")
      for option in ("mu 1", "mass 1", "charge 1", "units si")),
    (f"classify --ratio 1 {SI} --decimal --digits 30", "--decimal goes with --field"),
    (f"motion {BODY} --omega2 1 --decimal --json", "--decimal needs --digits"),
    (f"motion {BODY} --omega2 1 --times 1 --grid 0 1 5", "not both"),
    *((f"motion {BODY} --omega2 1 --grid 0 1 {count}", f"from 1 to 10000000, not {count}.")
      for count in ("0", "-1", "1.5", "10000001")),
    (f"motion {BODY} --omega2 1e400", "'1e400' is beyond the largest float"),
    (f"motion {BODY} --omega2 {'9' * 310}/1", "is beyond the largest float"),
    (f"motion {BODY} --omega2 1e12345", "an exponent of more than four digits"),
    (f"motion {BODY} --omega2 {'1' * 5000}", "has 5000 characters; a number has at most"),
    (f"motion {BODY} --omega2 1/0", "is not a finite number"),
    ("motion --inertia 1 2 3 --field 1 2 --omega2 1", "for three use atlas motion"),
    ("motion --field 0 1 2 --omega 1 2 3", "the body is missing: give one of --ratio"),
    ("motion --inertia 5 3 6 --points {place}/plain.csv --field 0 1 2 --omega 1 2 3", "by --inertia and --points"),
    ("elliptic --points {place}/leaning.csv --field 0 1 2 --z 1", "x, y, z are not principal axes"),
    ("motion --points {place}/plain.csv --magnetic 0 1 2 --omega 1 2 3", "has no column charge"),
    ("motion --points {place}/charged.csv --magnetic 0 1 2 --mass 1 --omega 1 2 3", "holds masses and charges"),
    ("motion --points {place}/plain.csv --field 0 1 2 --omega 1 2 3 --digits 5 --decimal", "not with --points"),
    ("general --ratio 1.5", "part of atlas motion, with --omega W1 W2 W3"),
    ("page general --ratio 1.5", "is atlas page motion"),
    ("motion --ratio 1 --field 1 2 --omega2 1 --times 0:1:1", "a range has at least 2 and"),
    ("figure hyperbola ratio=0.5", "a parameter has --set before it: --set ratio=0.5"),
    ("figure hyperbola --ratio 0.5", "given by --set ratio=VALUE"),
    ("motion --shape ring --radius 1kg --field 1 2 --omega2 1", "--radius is in m, or a unit that converts to it"),
    ("motion --ratio 1 --field 1T --angle 1 --omega2 1", "not in 'T'; --magnetic takes 'T'."),
    ("motion --shape ring --radius 1xx --field 1 2 --omega2 1", "there is no unit 'xx'"),
    ("motion --shape ring --radius 1m+ --field 1 2 --omega2 1", "there is no unit 'm+'"),
    ("motion --shape disc --radius 1 --field 1 2 --omega2 1", "did you mean disk?"),
    ("motion --ratio 1 --field 1Hz 2Hz --omega2 1Hz --digits 9 --decimal", "1Hz has pi in it"),
    ("motion --ratio 1 --field 1 --omega2 1 --angle", "--angle takes a value; found none"),
    ("motion --ratio 1 --field 1 2 --omega 300rpm 0 20", "--omega: 20 has no unit, and 300rpm beside it has one"),
    ("motion --ratio 1 --field 1 2 --omega 3 0 2 --times 1ms 2", "--times: 2 has no unit, and 1ms beside it has one"),
    ("motion --ratio 1 --field 1 2 --omega 3 0 2 --times 1ms:2:5", "--times: 2 has no unit, and 1ms beside it has one"),
    ("motion --ratio 1 --field 1 2 --omega 3 0 2 --grid 5 1ms 3", "--grid: 5 has no unit, and 1ms beside it has one"),
    ("sweep general --set omega3=1kHz:2:3 --out x.csv", "omega3: 2 has no unit, and 1kHz beside it has one"),
    ("motion --ratio 1 --angle 1 --omega2 1", "--angle goes with --magnetic B"),
    ("motion --ratio 1 --field 1 2 --omega2 1 --times --json", "--times takes T [T ...]; found none."),
    ("motion --ratio 1 --field 1 2 --omega2 1 --angle 1", "--field is one number, the strength of the field, not 2"),
    ("motion --shape ring --radius 1 --density 1 --magnetic 1 2 --charge 1 --omega2 1", "; give --mass instead"),
    ("motion --shape sphere --radius 1 --density 1 --mass 1 --field 1 2 --omega2 1", "all sizes of a sphere"),
    ("motion --ratio 1 --mu 1C/kg --magnetic 1 2 --units gaussian --omega2 1", "1C/kg is in SI"),
    ("page --ratio 1.5 --field 1 2 --title a\x01b", "leave out its control characters"),
    ("report your_body --ratio 1.5 --field 1 2 --only crad", "there is no part 'crad'"),
    ("report your_body --from toutatis --from gyroscope", "--from stands twice"),
    ("report your_body --ratio 1.5 --each a.csv --against toutatis", "--each and --against do not go together"),
    ("page --ratio 1.5 --field 1 2 --name a/b", "a name has letters, digits and"),
    ("page --fit {place}/one.csv", "5 times or more"),
    ("motion --ratio 1.5 --field 1 2", "the start is missing: give --omega2 W2"),
    ("motion --ratio 1.5 --field 1 2 --omega4 0.7", "No such option '--omega4'"),
    ("motion --ratio=1.5 --feild 1 2 --spin 1 --json", "No such option '--feild'"),
    ("motion --ratio 1.5 --field 1 2 --omega 1 2 3 --spin 1", "the start is given twice, by --omega and --spin"),
    ("motion --tensor 1 1 1 0 0 0 --ratio 1 --field 0 0 1 --spin 1", "by --ratio and --tensor"),
    ("motion --tensor 1 0.1 0.2 1.2 0.15 1.4 --field 0 0 1 --spin 1", "did you mean the order of URDF"),
    ("motion --tensor 1 1 1 0 0 0.1 --field 0 0 1 --spin 1 --attitude 0 0 1 1", "of the length 1, x y z w"),
    ("check {place}/plain.csv --ratio 1 --spin 1 --omega 1 2 3", "the start is given twice, by --omega and --spin"),
    ("sweep elementary --set ratio=1.3(1),1.4 B2=1 B3=2 omega2=0.3 --quantity k --out k.csv", "has one value"),
    ("sweep elementary --set ratio=1.3(1) B2=1 B3=2 omega2=0.3 --quantity k --digits 9 --out k.csv",
     "which has no certified digits"),
    (
        "sweep asymmetric --tensor 1 1.2 1.1 0.1 0 0.05(1) --field 0 0 1 --omega 0 0 1 --quantity f1 --out f.csv",
        "no uncertainties of a tensor",
    ),
    ("motion --ratio 1.3(1) --field 1 2 --omega2 0.3 --decimal", "without an uncertainty"),
    ("hyperbola --ratio 1.3 --field 2(1) --angle 1", "atlas motion carries those"),
    ("graph", "atlas figure NAME"),
    ("simulate --ratio 1.5", "atlas motion computes a motion in closed form"),
    ("gif hyperbola", "atlas animate NAME"),
    ("figure hyperbola --gif", "atlas animate NAME"),
    ("motion --ratio 1.5 --field 1 2 --omega2 0.7 -t 1", "there is no option -t: times are --times"),
    ("classify --ratio 1.5 --field 1 2 --out k.csv", "there is no option --out: numbers go to standard output"),
    ("fit k.csv --out y", "there is no option --out: numbers go to standard output"),
    ("free --ratio 1.5", "part of atlas motion, with --omega W1 W2 W3 without --field"),
    ("quadric --ratio 1.5", "there is no command atlas quadric: its name is atlas classify"),
    ("motion --ratio 1.5 --field=1,2 --omega3 1", "--omega3 goes with --omega2"),
    ("motion --ratio 1.5 --field 1,2 --omega2 1 --times 0..5", "or a range START:STOP:COUNT"),
    ("motion --ratio 1.5 --B 1 2 --omega2 1", "B is --magnetic"),
    ("motion --ratio 1.5 --field 1 2 --omega2 1 --latex", "and atlas tex its LaTeX"),
    ("motion --ratio 1.5(-1) --field 1 2 --omega2 1", "write an uncertainty as 1.5(1) or 1.5±0.1."),
    ("motion --ratio 1,5 --field 1 2 --omega2 1", "write 1.5"),
    ("figure cone --set ratio=0.5,field=1,2", "several parameters are several words"),
    ("sweep elementary ratio=1 --quantity k", "a parameter is one word, --set KEY=VALUE"),
    ("animate cone --over azimuth 0 360 90", "KEY=START:STOP:COUNT"),
    ("motion --ratio 1.3 --field 1 2 --omega2 0.3 --spectrum axis --digits 9", "--spectrum is computed in doubles"),
    ("motion --inertia 1(1) 2 2.5 --field 1 2 3 --spin 1 --curve", "--curve is proven"),
    ("motion --ratio 1.3 --field 1 2 --omega2 0.3 --times 0:2:3:log", "ends of one sign"),
    ("explore top --ratio 1", "leave out the name, or the options"),
    ("motion --inertia 5 3 6 --field 0 1 2 --mu 1 --omega 1 2 3", "--mu goes with --magnetic only"),
    (f"{TOP} --inertia 1 1 --mass 1", "--mass goes with --heavy or --magnetic"),
    (f"{TOP}", "--inertia is missing"),
    ("top --inertia 1 1 --omega 1 2 3", "--direction is missing"),
    ("top --inertia 1 1 --direction 1 2", "the start is missing: give --omega W1 W2 W3"),
    (f"{TOP} --inertia 1 1 --heavy 1 1 --mass 1 --decimal --digits 30", "--decimal goes with"),
    (f"{TOP} --inertia 1 1 --heavy 1 1 --magnetic 1 2", "--heavy needs --mass"),
    *((f"{TOP} --inertia 1 1 --heavy 1 1 --mass 1 --{option}", f"--{option.split()[0]} is computed from --heavy")
      for option in ("coupling 0 1", "linear 1", "quadratic 1")),
    ("top --inertia 1 1 --magnetic 1 2 --charged 1 1 --direction 1 2 --omega 1 2 3",
     "--direction is the direction of --magnetic"),
    (f"{TOP} --heavy 1 1 --mass 1", "the body is missing: give one of --inertia"),
    (f"{TOP} --heavy 1 1 --mass 1 --inertia 1 1 --shape ring", "by --inertia and --shape"),
    ("top --inertia 1 1 --magnetic 1 2 --omega 1 2 3", "the charge is missing: give one of --charged"),
    ("top --inertia 1 1 --magnetic 1 2 --charged 1 1 --coat ring --omega 1 2 3", "by --charged and --coat"),
    ("top --points {place}/plain.csv --magnetic 1 2 --omega 1 2 3", "the columns x, y, z, mass, charge; it has x,"),
    ("top --points {place}/charged.csv --mass 1 --magnetic 1 2 --omega 1 2 3", "the file of --points has the masses"),
    (f"{TOP} --inertia 1 1 --heavy 1 1", "--heavy needs --mass"),
    ("top --inertia 1 1 --heavy 1 1 --mass 1 --omega 1 2 3", "--heavy needs --direction"),
    ("top --inertia 1 1 --mass 1 --magnetic 1 2 --charged 1 1 --omega 1 2 3", "--mass goes with --heavy or --shape"),
    ("top --shape ring --radius 1 --magnetic 1 2 --charged 1 1 --omega 1 2 3", "--shape needs --mass"),
    ("top --inertia 1 1 --magnetic 1 2 --coat ring --radius 1 --omega 1 2 3", "--coat needs --charge"),
    (f"{TOP} --inertia 1 1 --heavy 1 1 --mass 1 --charged 1 1", "--charged goes with --magnetic, not with --heavy"),
    *((f"animate motion --over {text} --out {{place}}/a", "a range is START:STOP:COUNT")
      for text in ("omega2=0:2", "omega2=0:2:x", "omega2=0:2:3:4")),
    ("classify --ratio 1 --field 1 2 3", "--field takes 2 numbers"),
    ("animate motion --over omega2=0:2:1000000 --out {place}/new", "at most 2000 values, not 1000000"),
    *(
        (f"animate motion --over {text} --out {{place}}/new", "from a list to one as long")
        for text in ("field=1,2:3:4", "field=1,2:1,2,3:4", "ratio=x:1:2")
    ),
    ("figure cone --set field=0,1 --out {place}/new", "cone"),
    ("verify 72 --record", "name none"),
    ("verify --script", "name one equation"),
    ("fit {place}/one.csv --fix ratio", "is not NAME=VALUE"),
    ("fit {place}/one.csv --fix ratio=1.4 --start ratio=1.5", "ratio is given twice"),
    ("check {place}/none.csv", "none.csv"),
    ("check {place}/sub", "sub"),
    (f"{SWEEP} --list {{place}}/bytes.csv", "no parameter 'ÿ' here"),
    (f"{SWEEP} --list {{place}}/nul.csv", "nul.csv, line 2 cannot be read as CSV: field larger"),
    (f"{SWEEP} --list {{place}}/twice.csv", "a heading of different names"),
    (f"{SWEEP} --list {{place}}/bare.csv", "at least one row"),
    (f"{SWEEP} --list {{place}}/short.csv", "line 5: 1 cells where the line of names has 2"),
    (f"{SWEEP} --list {{place}}/word.csv", "line 4: 'two' under x is not a number"),
    ("sweep asymmetric --inertia 0.8 1 1.3 --set B1=0 --mu 1 --quantity H", "the field is missing"),
    ("sweep --quantity k --out {place}/out.csv", "name the family to sweep"),
    ("sweep elementary --quantity k --set ratio=1", "--out is missing"),
    ("sweep elementary --quantity k --set ratio=1 --out memory://out", "is gone when the command ends"),
    ("sweep elementary --quantity k --list /dev/zero --out {place}/out.csv", "zero has a line of more than"),
    ("fit /dev/zero", "zero has a line of more than"),
    ("sweep general --inertia 0.8 1 1.3 --quantity k --out {place}/out.csv", "is the family asymmetric"),
    (f"{SWEEP} --set ratio=1 --set ratio=2", "ratio is given 2 times, by --set:"),
    (f"{SWEEP} --list {{place}}/ratios.csv --set ratio=2", "ratios.csv and elsewhere: give it once"),
    (f"{SWEEP} --ratio 1 --set ratio=2", "by --set and the options of body and field"),
    *((f"{SWEEP} --set {text}", "--set takes NAME=VALUES") for text in ("ratio", "=1", "ratio=")),
    *((f"{SWEEP} --set ratio={text}", "a range is START:STOP:COUNT")
      for text in ("1:2", "1:2:x", "1:2:3:lin", "1:2:3:log:4", "1:2:²")),
    *((f"{SWEEP} --set ratio={text}:3:log", "ends of one sign") for text in ("0:1", "-1:1", "1:0")),
    *((f"{SWEEP} --set ratio=1:2:{text}", f"at most 10000000 values, not {text}")
      for text in ("10000001", "999999999999999999999")),
    ("figure", "name the figures, or say --all"),
    ("figure cone --all", "name the figures, or say --all"),
    ("figure {place}/one.py {place}/sub/one.py", "have the same name"),
    ("figure cone --set field", "--set takes KEY=VALUE"),
    ("figure cone --format csv --out {place}", "cone.csv is not as atlas wrote it: the new one is cone.new.csv"),
    ("report atlas --out {place}/ratios.csv/new", "ratios.csv' is a file"),
    ("animate film_strip --out {place}/mine.gif", "mine.gif' ends as a file does"),
    ("report atlas --out {place}/lost", "lost' is a link to nothing"),
    *((f"classify --ratio {ratio} --field 1 2", ratio)
      for ratio in ("2.5", "0", "-1", "nan", "one", "1_0", "\N{ARABIC-INDIC DIGIT ONE}")),
    ("classify --ratio 1e-1_000_000 --field 1 2 --decimal", "'1e-1_000_000' is not a finite number"),
    ("classify --shape ring --radius 0 --field 1 2", "radius must be positive"),
    ("classify --inertia 1 3 --field 1 2 --json", "at most 2 I2"),
    ("classify --ratio 1.5 --magnetic 1e308 2 --mu 1e308", "larger units"),
    (f"classify {BODY} --digits 1001", "1001"),
    ("classify --rato 1", "--rato"),
    ("classify --ratio 1.5 --field 1 2 --json=1", "'--json' does not take a value"),
    ("clasify --ratio 1", "clasify"),
    ("classify --ratio 1.5 --mu 1 --magnetic 0 1 2", "--magnetic takes 2 numbers, B2 B3"),
    ("classify --ratio 1.5 --magnetic 1 2 --charge 1 --mass 0", "mass must be positive"),
    *((f"hyperbola --ratio 1.5 --field {field}", "too far apart") for field in ("1e300 1e-300", "1e-300 1e300")),
    ("hyperbola --ratio 1.5 --field 1e308 1e308", "beyond the largest float"),
    ("hyperbola --ratio 1.5 --field 0 0", "no curve"),
    (f"hyperbola {BODY} --count 1", "--count"),
    ("ball --larmor 1 --momentum 1 1 --inertia 0", "inertia"),
    ("particle --mu 1e308 --magnetic 0 0 1e308 --velocity 1 0 0 --times 1 --json", "larger units"),
    ("particle --charge 1 --magnetic 0 0 1", "needs --mass,"),
    ("particle --mass 2 --charge 1 --mu 1", "leave out --mass"),
    ("particle --mass 0 --charge 1", "mass must be positive"),
    (f"motion {BODY} --omega2 -1 --times 0", "-1"),
    ("elliptic --inertia 0.8 1 1.3 --field 2 --angle 30deg --z 1.7", "of another body --field has three components"),
    (f"motion {BODY} --omega2 1 --omega 1 2 3", "--omega does not go with --omega2"),
    (f"motion {BODY} --omega 1 2 3 --spectrum --least 0", "--least is a fraction between 0 and 1"),
    (f"motion {BODY} --omega2 1 --times", "--times"),
    (f"motion {BODY} --omega2 1e3 --times 1e30 --json", "2^50"),
    (f"motion {BODY} --omega2 0.3 --times 1(1)", "atlas motion carries those"),
    ("page --ratio 1.3 --field 1 2 --omeg 1 2 3 --out {place}/new", "--omeg"),
    ("page motion --ratio 1.3 --field 1 2 --out {place}/new", "--omega2"),
    ("page nosuch --ratio 1", "nosuch"),
    ("motion --ratio 1 --field 1Hz --angle 30 --omega2 1Hz", "--angle: 30 has no unit, and 1Hz has one"),
    ("motion --ratio 1 --field 1 2 --omega2 300rpm", "--field: 1 has no unit, and 300rpm has one"),
    ("sweep elementary --ratio 1 --field 1 2 --set omega2=1Hz:9Hz:3 --out x.csv", "--field: 1 has no unit, and 1Hz"),
    ("sweep general --set omega1=2 omega3=1kHz:2kHz:3 --out x.csv", "omega1: 2 has no unit, and 1kHz has one"),
    ("motion --shape sphere --radius 0 --density 1 --charge 1 --magnetic 1 0 --omega2 1", "no volume"),
    ("report atlas --set a=1 --set a=2", "--set a=... stands twice"),
    ("report your_body", "your_body takes a body, a field and a start"),
    ("report your_body --from {place}/bad.toml", "--from takes a file NAME.inputs.toml"),
    ("report your_body --from toutatis --from gyroscope", "--from stands twice"),
    ("page --ratio 1.5 --field 1 2 --omega2 1 --title a\x07", "leave out its control characters"),
    ("report your_body --each {place}/other.csv --against toutatis", "do not go together"),
    ("report your_body --each {place}/other.csv --out {place}/new", "spicy"),
    ("sweep general --ratio 1.5 --mu 1 --magnetic 1 2 2 --quantity k", "--magnetic takes 2 numbers, B2 B3"),
    ("sweep general --ratio 1.5 --set omega3=1kg:2kg:3 --quantity k", "--omega is in rad/s"),
    ("top --inertia 1 0.5 --direction 0 0 --omega 0 0 1", "zero vector"),
    ("top --inertia 1 2.5 --direction 0 1 --omega 0 0 1", "at most 2 I2"),
    (f"{DISK} --coat disk --charge 1 --magnetic 1 2", "not parallel to the field"),
    (f"{DISK} --coat disk --charge 1 --magnetic 0 0", "no direction"),
    (f"{DISK} --charge 2", "--charge goes with --magnetic"),
    (DISK.replace("0.04", "1e200"), "too large"),
    (DISK.replace("9.81", "-9.81"), "must not be negative"),
    (f"{CHARGED} --charge 3", "--charge goes with --coat"),
    (CHARGED.replace("1 2 --omega", "0 0 --omega"), "no direction"),
    ("animate cone --out {place}/new", "'cone' has no time t"),
    ("animate cone --out {place}/new", "(at the shell, --over KEY=START:STOP:COUNT)"),
    ("animate film_strip --over= --out {place}/new", "KEY=START:STOP:COUNT"),
    ("animate rolling_cones --over omega2=-1:1:3 --out {place}/new", "omega2 = -1.0: omega2 = -B2 = -1.0 is the pole"),
    ("animate no_such --over azimuth=0:90:4 --out {place}/new", "no figure 'no_such'"),
    (f"{OVER} azimuth=0:720:5", "azimuth must lie between -360 and 360, not 540"),
    (f"{OVER} azimuth=0:x:5", "from a number to a number"),
    (f"{OVER} azimuth=0:90:1", "at most 2000 values, not 1."),
    (f"{OVER} azimuth=0:90:\u0663", "a range is START:STOP:COUNT"),
    (f"{OVER} tilt=0:90:4", "no parameter 'tilt'"),
    ("animate film_strip --over tilt=0:1:3 --out {place}/new", "azimuth, elevation, t"),
    (f"{OVER} azimuth=0:90:4 --set azimuth=3", "which can't have the value 3 too"),
    (f"{OVER} azimuth=0:90:4 --fps 55", "gif has from 1 to 50 frames a second, not 55"),
    ("figure nosuchfigure", "nosuchfigure"),
    ("figure hyperbola --format pdf --renderer shaded --out {place}/new", "PNG"),
    ("figure hyperbola --set field=1e308,1e308 --out {place}/new", "field must be two numbers"),
    ("report nosuchreport", "nosuchreport"),
    ("verify 999", "999"),
    ("motion --points {place}/oblique.csv --field 0 0 1 --omega 1 1 1 --digits 9 --decimal", "--decimal goes with"),
    ("motion --ratio 1.5 --field 1 2 --omega2 .7 --out {place}/out.csv", "give one of them"),
    ("motion --ratio 1.5 --field 1 2 --omega2 .7 --times 1 --json --out {place}/out.csv", "--out writes doubles"),
    ("fit {place}/one.csv", "5 times or more"),
    ("fit {place}/parts.csv", "of a quaternion qw is the scalar"),
    ("fit {place}/letters.csv", "not a number"),
    ("fit {place}/partly.csv", "no columns"),
    ("fit {place}/still.csv --of axis", "no columns of axis"),
    ("fit {place}/still.csv", "All times are equal"),
    ("sweep foo --set a=1 --quantity k --out {place}/out.csv", "no family 'foo'"),
    (f"{GAMMA} --set a=1", "no parameter 'a'"),
    (f"{GAMMA} --set inertia=1", "larmor is missing"),
    (f"{GAMMA} --set inertia=1 --quantity k", "no quantity 'k'"),
    (f"{GAMMA}/ --set inertia=1 larmor=1 m2=1 m3=1", "of Parquet"),
    ("sweep ball --quantity gamma --out ://y --set inertia=1 larmor=1 m2=1 m3=1", "is no address"),
    ("sweep ball --quantity gamma --out file:// --set inertia=1 larmor=1 m2=1 m3=1", "is no address"),
    ("sweep ball --quantity gamma --out no://x/ --set inertia=1 larmor=1 m2=1 m3=1", "cannot be reached"),
]  # fmt: skip
ELSEWHERE = (
    "{verdict.name}: {text}",  # of an entry without a script, which takes a trial
    "cannot be read: {error.strerror}",
    "ClickException(message)",
    "was changed since it was made",
    "NotCertifiedError(best.reason)",  # which takes seconds: `Best` is tried in test_cli_certified
    "is not TOML",
    "its folder is read-only",
    "has more than {MAX_ROWS} rows",
    "exceptions.Exit(_reader_gone())",
    "no JSON for",
    "raise error",
    "FaultsError(",  # of several options at fault, in test_your_body
    "raise ValueError(text)",
    "a ratio, three moments or a tensor (3, 3) is wanted",  # of an object of Python
    "OPTIONS, 'of a body'",  # of a keyword in Python or a column of a table, in test_several_bodies
    "AtlasError(error.format_message())",  # of one row of several, which the index lists
)
"""Refusals that no words alone bring about."""


@pytest.fixture
def place(tmp_path: Path) -> Path:
    """Return a folder with files that are wrong, each in its way."""
    (tmp_path / "sub").mkdir()
    (tmp_path / "lost").symlink_to("nothing")
    for name, text in FILES.items():
        (tmp_path / name).write_bytes(text if isinstance(text, bytes) else text.encode())
    return tmp_path


def refusal(words: list[str]) -> tuple[str, set[tuple[str, int]]]:
    """Return the command line's message to words that it refuses, and the lines of code on the way."""
    with pytest.raises((click.ClickException, AtlasError)) as caught:
        command.main(words, prog_name="atlas", standalone_mode=False)
    error, passed, cause = caught.value, set[tuple[str, int]](), caught.value
    while cause:  # an error of another floor, of which a word of the command line is the cause, is told by `fail`
        passed |= {(Path(frame.f_code.co_filename).name, line) for frame, line in walk_tb(cause.__traceback__)}
        cause = cause.__cause__ or cause.__context__  # type: ignore[assignment]
    return error.format_message() if isinstance(error, click.ClickException) else str(error), passed


@pytest.mark.slow
def test_every_refusal_of_the_command_line_has_a_case(place: Path) -> None:
    """Of every statement that raises in atlas/cli, and each call of `fail`, a case stands above; nothing is written."""
    reached, unreached = set(), list[str]()
    for text, says in CASES:
        message, passed = refusal(text.format(place=place).split())
        assert says in message, text
        assert "\n" not in message, text
        reached |= passed
    assert not (place / "out.csv").exists()
    assert not list((place / "new").rglob("*"))
    folder = Path(cli.__file__).parent
    for path in folder.glob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            fails = isinstance(node, ast.Expr) and re.match(r"self\.fail\(", ast.unparse(node))
            if (isinstance(node, ast.Raise) and node.exc is not None) or fails:
                lines = range(node.lineno, (node.end_lineno or node.lineno) + 1)
                is_reached = any((path.name, line) in reached for line in lines)
                elsewhere = any(words in ast.unparse(node) for words in ELSEWHERE)
                if not (is_reached or elsewhere):
                    unreached.append(f"{path.name}:{node.lineno}")
    assert not unreached, " ".join(unreached)


@pytest.mark.parametrize(
    ("error", "status", "says"),
    [
        (click.UsageError("wrong"), 2, "wrong"),
        (AtlasError("wrong"), 2, "wrong"),
        (OSError(28, "no space", "a.csv"), 1, "no space: a.csv"),
        (PermissionError(13, "Permission denied", "a.csv"), 2, "Permission denied: a.csv; choose another path"),
        (KeyboardInterrupt(), 130, "interrupted"),
        (KeyboardInterrupt(signal.SIGTERM), 143, "interrupted"),
        (MemoryError(), 1, "there is not enough memory; ask for fewer numbers at once"),
        (AtlasError(f"{'a' * 400} {'b' * 401}"), 2, f"{'a' * 400} {'b' * 200}…{'b' * 100}"),  # long words are cut
    ],
    ids=["usage", "input", "disk", "path", "interrupt", "end", "memory", "long"],
)
def test_every_failure_is_one_line_and_a_status(
    error: BaseException, status: int, says: str, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    """2 for a wrong input, 1 for a failure, 128 and the signal's number for an interruption."""

    def failing(*_: Any, **__: Any) -> None:
        raise error

    monkeypatch.setattr(command, "main", failing)
    with pytest.raises(SystemExit) as ended:
        main([])
    assert ended.value.code == status
    assert capsys.readouterr().err == f"atlas: {says}\n"


def test_a_table_without_an_end_is_given_up(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """More rows than a table may have are refused."""
    file = tmp_path / "long.csv"
    swept = f"sweep ball --quantity gamma --list {file} --out {tmp_path}/out.csv"
    for module, name, most, words in ((points, "MAX_ROWS", 3, swept),
                                (data, "MAX_BLOCKS", 1, f"fit {file}")):  # fmt: skip
        monkeypatch.setattr(module, name, most)
        file.write_text("t,R11\n" + 8193 * "0,1\n", encoding="utf-8")
        assert "long.csv has more than" in refusal(words.split())[0]


def test_too_few_numbers_are_reported_before_the_next_option() -> None:
    """The name of the next option was not meant for a number."""
    message, _ = refusal("motion --ratio 1.5 --field 1 2 --omega 0.7 --times 1".split())
    assert message == "--omega takes 3 numbers, W1 W2 W3; found 1."
