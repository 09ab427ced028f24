"""Figures as data: layers with roles, how the roles look, and the recipes that make them.

Classes of layers are loaded when they are first used: the names of recipes need no NumPy.
"""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from atlas.pictures.layers import Arrow as Arrow
    from atlas.pictures.layers import Curve as Curve
    from atlas.pictures.layers import Image as Image
    from atlas.pictures.layers import Label as Label
    from atlas.pictures.layers import Layer as Layer
    from atlas.pictures.layers import Panel as Panel
    from atlas.pictures.layers import Plane as Plane
    from atlas.pictures.layers import Points as Points
    from atlas.pictures.layers import Region as Region
    from atlas.pictures.layers import Scene as Scene
    from atlas.pictures.layers import Space as Space
    from atlas.pictures.layers import Surface as Surface
else:

    def __getattr__(name: str) -> Any:
        """Return the class `name` of `atlas.pictures.layers`, which is imported at first use.

        Raises AttributeError for a name that begins with a small letter or that is no class there.
        """
        if not name[0].isupper():
            raise AttributeError(f"module 'atlas.pictures' has no attribute {name!r}")
        import atlas.pictures.layers as classes

        return globals().setdefault(name, getattr(classes, name))
