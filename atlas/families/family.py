"""A family of motions or surfaces as data: its parameters, its quantities, and the classes that compute them."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from functools import partial
from importlib import import_module
from operator import attrgetter
from typing import Any

RATE, TIME = "1/time", "time"
ROUNDING = 1e-12
"""Turn of a body in rad, by rounding of the inputs to floats, above which the reader is told."""


@dataclass(frozen=True)
class Parameter:
    """A parameter of a family's two classes, double and certified, under its name in both.

    name      as `--name` and, of a number, as a column
    says      its meaning, the help of the option `--name`
    unit      in which it is given, "" of a pure number
    default   where its sliders start, one number a component; () without a slider
    range     the ends of each slider
    needed    whether it has to be given
    omitted   the value of each component where it is not given, or None for the class's own default
    columns   names of the components of a vector; () of a number
    metavar   its values in the help of the command, None for the usual
    last      whether arrays of vectors have the components last, else they are a tuple of arrays
    option    whether the command has the option `--name`
    """

    name: str
    says: str
    unit: str
    default: tuple[float, ...]
    range: tuple[float, float]
    needed: bool = True
    omitted: float | None = None
    columns: tuple[str, ...] = ()
    metavar: str | None = None
    last: bool = False
    option: bool = True

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the parameter's columns in a table: its components, or its own name."""
        return self.columns or (self.name,)


@dataclass(frozen=True)
class Quantity:
    """A number of a family, several that belong together, or a name.

    name       as an attribute of both classes, and in a table; `columns` names the components of several
    says       its meaning, in a few words
    unit       "" of a pure number and of a name
    equation   where it stands in the paper
    cases      (says, equation) by the name of a case, where these differ there
    symbol     in a printout, the name if there is none
    lines      (symbol, words) of each component that is printed on its own line
    get        how to get it from an object of kernels, where that is no attribute; `exact`, from one of balls
    drawn      how to get it where inputs are uncertain: a function of an object of kernels at moved inputs and,
               as `reference`, of the value at the unmoved inputs
    text       how the texts of its digits become one text
    missing    why there may be none: an empty cell then, which this explains; "" where that is an error
    checked    its name in a stress run, if it has a promise or is checked without one
    certified  whether a sweep gives it in certified digits
    printed    whether a command prints it
    tabled     whether a table has it
    slow       whether it takes more than a few milliseconds, as a proof does: not while a slider moves

    "Kernels" are the family's class in doubles, "balls" the certified one.
    """

    name: str
    says: str = ""
    unit: str = ""
    equation: str = ""
    cases: Mapping[str, tuple[str, str]] = field(default_factory=dict)
    symbol: str = ""
    lines: tuple[tuple[str, str], ...] = ()
    columns: tuple[str, ...] = ()
    get: Callable[[Any], Any] | None = None
    exact: Callable[[Any], Any] | None = None
    drawn: Callable[..., Any] | None = None
    text: Callable[[Any], str] = str
    missing: str = ""
    checked: str = ""
    certified: bool = False
    printed: bool = True
    tabled: bool = True
    slow: bool = False

    def value(self, subject: Any, *, exact: bool = False) -> Any:
        """Return the value of the quantity of an object ``subject`` of the class in doubles or, if ``exact``, in balls.

        The value is a float, an array, a ball, a tuple of these or a name, as the class has it.
        """
        return ((exact and self.exact) or self.get or attrgetter(self.name))(subject)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the quantity's columns in a table; () where it is not `tabled`."""
        return (self.columns or (self.name,)) if self.tabled else ()


@dataclass(frozen=True)
class Sampled:
    """A function of time of a family: a vector or, if `matrix`, a matrix.

    `method` is the name of the method of both classes that computes the function, `name` its name in tables, `says`
    its meaning, `equation` where it stands, `symbol` its symbol in a printout, `checked` its name in a stress run,
    `printed` whether a command prints it. `components` are the endings of its columns, 1, 2, 3 if there are none.
    `uncertified` says that the class in balls does not have it.
    """

    name: str
    method: str
    says: str
    unit: str = ""
    equation: str = ""
    symbol: str = ""
    matrix: bool = False
    checked: str = ""
    printed: bool = True
    components: tuple[str, ...] = ()
    uncertified: bool = False

    def method_of(self, motion: Any) -> Callable[[Any], Any]:
        """Return the bound method of a motion, called `method`, that maps times t to the values of the function."""
        method: Callable[[Any], Any] = getattr(motion, self.method)
        return method

    @property
    def heading(self) -> list[str]:
        """Headings of the columns in which a command prints the function: three for a matrix, one for a vector.

        A vector or a row of a matrix has its components in three rows for each time.
        """
        if self.matrix:
            return [f"{self.name}_i{j}" for j in (1, 2, 3)]
        symbol = self.symbol or f"{self.name}_i"
        return [f"{symbol} [{self.unit}]" if self.unit else symbol]

    @property
    def columns(self) -> dict[str, Callable[[Any, Any], Any]]:
        """The components in a table by column name, each a function of (motion, time or array of times).

        A matrix has nine columns, such as "R11", a vector one for each component, such as "Omega1".
        """
        if self.matrix:
            return {f"{self.name}{i}{j}": partial(_entry, i, j) for i in (1, 2, 3) for j in (1, 2, 3)}
        return {f"{self.name}{x}": partial(_component, self.method, i) for i, x in enumerate(self.components or "123")}


def _entry(i: int, j: int, motion: Any, t: Any) -> Any:
    return motion.column(j, t)[..., i - 1]


def _component(method: str, i: int, motion: Any, t: Any) -> Any:
    return getattr(motion, method)(t)[..., i]


@dataclass(frozen=True)
class Command:
    """The command `atlas NAME` of a family.

    `summary` is its line in a list, `help` and `examples` are its help. `title` stands over the output, and is
    completed by the value of the quantity `named`, if that is not "". With `undecided` a number may be zero without
    a proof: its digits are sought up to a limit, beyond which it is called undecided.
    """

    name: str
    summary: str
    help: str
    examples: tuple[str, ...]
    title: str
    named: str = ""
    undecided: bool = False


@dataclass(frozen=True)
class Family:
    """A family of motions or surfaces, as one line of the register.

    name          of the family; `says` describes it in words
    source        the class with its module, where "{}" stands for "kernel" or "certified"
    parameters    in the order of both classes' constructors
    quantities    numbers of one object; `sampled`, functions of time
    promises      largest errors, in ulps, by the names of a stress run: of quantities and of other checked values
    command       the command of the family, or None
    typed         without a command, words that ask for an object at the command line, before its parameters
    at_once       objects that a table computes in one array
    figures       recipes that draw one object, from parameters of the same names
    instead       parameters for which other options may stand
    last_axis     words on the last of the class's axes
    is_sensitive  whether derivatives in the inputs take milliseconds only
    in_given_axes whether commands take any axes of the body and an attitude
    axis_rate     name of the rate at which the third axis precesses, where it does not nutate
    in_plane      function that converts arguments to axes in which the field has two components, and returns
                  (arguments, the rotation to these axes or None)
    """

    name: str
    says: str
    source: str
    parameters: tuple[Parameter, ...]
    quantities: tuple[Quantity, ...]
    sampled: tuple[Sampled, ...] = ()
    promises: Mapping[str, float] = field(default_factory=dict)
    command: Command | None = None
    at_once: int = 50_000
    figures: tuple[str, ...] = ()
    typed: tuple[str, ...] = ()
    instead: tuple[str, ...] = ()
    last_axis: str = ""
    is_sensitive: bool = False
    in_given_axes: bool = False
    axis_rate: str = ""
    in_plane: Callable[[dict[str, Any]], tuple[dict[str, Any], Any]] | None = None

    def takes(self, name: str) -> bool:
        """Return whether the family has a parameter called ``name``."""
        return any(p.name == name for p in self.parameters)

    def quantity(self, name: str) -> Quantity | None:
        """Return the `Quantity` called ``name``, None where the family has none."""
        return next((q for q in self.quantities if q.name == name), None)

    @property
    def page(self) -> str:
        """Name in `atlas page NAME`: the command's, or the family's where several families share a command."""
        return self.command.name if self.command and self.command.summary else self.name

    @property
    def words(self) -> tuple[str, ...]:
        """Words typed after `atlas`, before the parameters; () for a family that no command computes."""
        return (self.command.name,) if self.command else self.typed

    def case(self, subject: Any) -> str:
        """Return the name of the case of an object ``subject``, by which words differ; "" in a family without cases."""
        return str(getattr(subject, self.command.named)) if self.command and self.command.named else ""

    def kernels(self) -> Any:
        """Import and return the class that computes in doubles."""
        return self._class("kernel")

    def balls(self) -> Any:
        """Import and return the class that computes in balls."""
        return self._class("certified")

    def _class(self, kind: str) -> Any:
        module, _, name = self.source.rpartition(".")
        return getattr(import_module(f"atlas.{module.format(kind)}"), name)
