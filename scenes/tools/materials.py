# SPDX-FileCopyrightText: 2026 the mapscore authors
# SPDX-License-Identifier: MIT
"""What the homes share: classes in the order of their ids, meshes, textures and materials."""

# name: (colour, detected). The first 35 are those of apartment.xml.
CLASSES = {
    "cup": ("FF0000", True),
    "bottle": ("00FF00", True),
    "chair": ("0000FF", True),
    "oven": ("FF00FF", True),
    "tv": ("00FFFF", True),
    "table": ("A0522D", False),
    "sofa": ("4A6FA5", False),
    "wall": ("D8D0B8", False),
    "floor": ("8B7355", False),
    "ceiling": ("EFEFE4", False),
    "lamp": ("FFD700", False),
    "rug": ("7B1E1E", False),
    "fridge": ("9FB6CD", False),
    "cabinet": ("C0C0C0", False),
    "counter": ("555555", False),
    "shelf": ("CD853F", False),
    "book": ("6A0DAD", False),
    "plant": ("228B22", False),
    "picture": ("FF8C69", False),
    "curtain": ("E6A15C", False),
    "window": ("BFE3FF", False),
    "sky": ("66B2FF", False),
    "door": ("8F5A2A", False),
    "sink": ("708090", False),
    "tap": ("A9B7C6", False),
    "cushion": ("FFA500", False),
    "hob": ("301010", False),
    "pot": ("5F9EA0", False),
    "hood": ("3F4F5F", False),
    "plate": ("FFF5CC", False),
    "bowl": ("2F4F8F", False),
    "laptop": ("2E2E5C", False),
    "radiator": ("F0C8D8", False),
    "box": ("B8A06A", False),
    "bin": ("3C5A3C", False),
    "bed": ("B565A7", False),
    "pillow": ("F5DEB3", False),
    "wardrobe": ("7A5C3E", False),
    "toilet": ("E0FFFF", False),
    "bath": ("AFEEEE", False),
    "mirror": ("8DA9C4", False),
    "towel": ("DB7093", False),
    "kettle": ("B22222", False),
    "vase": ("40E0D0", False),
    "clock": ("F4A460", False),
    "washing_machine": ("778899", False),
    "basket": ("BDB76B", False),
}

# texture: kind
_TEXTURES = {
    "grain": "cube",
    "planks": "2d",
    "tiles_floor": "2d",
    "tiles_wall": "2d",
    "tiles_blue": "2d",
    "carpet": "2d",
    "weave": "2d",
    "stone": "cube",
    "rug": "2d",
    "stripes": "2d",
    "checks": "2d",
    "spine": "cube",
    "garden": "2d",
    "landscape": "2d",
    "film": "2d",
    "abstract": "2d",
    "portrait": "2d",
    "desktop": "2d",
    "clock": "2d",
}

# file, and its scales where one file serves several sizes
_MESHES = [
    "mug",
    "mug_low",
    "bowl",
    "bowl_small",
    "plate",
    "wine_bottle",
    "water_bottle",
    "soap_bottle",
    "vase",
    "tulip_stems",
    "tulip_heads",
    "flower_pot",
    "flower_pot_small",
    "ficus",
    "sword_plant",
    "shade_floor",
    "shade_table",
    "shade_pendant",
    "lamp_foot",
    "kettle",
    "pot",
    "pan",
    "basket",
    "tap",
    "tap_low",
    "kitchen_sink",
    "wash_basin",
    "bath",
    "toilet",
    "pillow",
    "cushion",
    "curtain",
    "duvet",
    "duvet_single",
    "chair_seat",
    "chair_back",
    "chair_rail",
    "shell_chair",
]
_SCALED = {
    "sofa_seat": ("soft_block", "0.62 0.76 0.17"),
    "sofa_back": ("soft_block", "0.17 0.76 0.40"),
    "sofa_arm": ("soft_block", "0.86 0.19 0.40"),
    "mattress": ("soft_block", "2.0 1.6 0.20"),
    "mattress_single": ("soft_block", "2.0 0.9 0.18"),
    "pouf": ("soft_block", "0.46 0.46 0.40"),
}

# material: texture or "", rgb, more
_MATERIALS = {
    "planks": (
        "planks",
        "1 1 1",
        'texuniform="true" texrepeat="0.9 1.8" specular="0.15" shininess="0.3"',
    ),
    "planks_grey": (
        "planks",
        "0.86 0.92 1",
        'texuniform="true" texrepeat="0.7 1.4" specular="0.15" shininess="0.3"',
    ),
    "tiles_floor": (
        "tiles_floor",
        "1 1 1",
        'texuniform="true" texrepeat="3 3" specular="0.15" shininess="0.4"',
    ),
    "tiles_wall": (
        "tiles_wall",
        "1 1 1",
        'texuniform="true" texrepeat="2.5 2.5" emission="0.12" specular="0.1"',
    ),
    "tiles_blue": ("tiles_blue", "1 1 1", 'texuniform="true" texrepeat="3.3 3.3" specular="0.1"'),
    "carpet": ("carpet", "1 1 1", 'texuniform="true" texrepeat="1.3 1.3" specular="0"'),
    "oak": ("grain", "0.80 0.62 0.40", 'specular="0.1"'),
    "walnut": ("grain", "0.50 0.33 0.21", 'specular="0.1"'),
    "birch": ("grain", "0.93 0.83 0.66", 'specular="0.1"'),
    "ashgrey": ("grain", "0.62 0.60 0.57", 'specular="0.1"'),
    "granite": ("stone", "0.42 0.42 0.44", 'specular="0.2"'),
    "soil": ("stone", "0.32 0.22 0.15", 'specular="0"'),
    "sofa_cloth": ("weave", "0.36 0.46 0.56", 'specular="0" texrepeat="12 12"'),
    "sofa_light": ("weave", "0.45 0.55 0.65", 'specular="0" texrepeat="12 12"'),
    "moss_cloth": ("weave", "0.50 0.56 0.38", 'specular="0" texrepeat="12 12"'),
    "seat_cloth": ("weave", "0.75 0.70 0.60", 'specular="0" texrepeat="6 6"'),
    "black_cloth": ("weave", "0.17 0.18 0.20", 'specular="0" texrepeat="6 6"'),
    "ochre_cloth": ("weave", "0.95 0.66 0.18", 'specular="0" texrepeat="5 5"'),
    "teal_cloth": ("weave", "0.16 0.48 0.50", 'specular="0" texrepeat="5 5"'),
    "red_cloth": ("weave", "0.78 0.27 0.20", 'specular="0" texrepeat="5 5"'),
    "linen": ("weave", "0.98 0.97 0.94", 'specular="0" texrepeat="5 5"'),
    "checks": ("checks", "1 1 1", 'specular="0" texrepeat="2 2"'),
    "rug": ("rug", "1 1 1", 'specular="0"'),
    "runner": ("rug", "1 1 1", 'specular="0" texrepeat="4 1"'),
    "rug_blue": ("stripes", "0.40 0.47 0.62", 'specular="0" texrepeat="3 3"'),
    "mat": ("stripes", "0.45 0.60 0.62", 'specular="0" texrepeat="2 2"'),
    "drape": ("stripes", "0.90 0.74 0.52", 'specular="0" texrepeat="5 1"'),
    "drape_blue": ("stripes", "0.52 0.62 0.76", 'specular="0" texrepeat="5 1"'),
    "towel_red": ("stripes", "0.80 0.36 0.33", 'specular="0"'),
    "towel_blue": ("stripes", "0.35 0.52 0.70", 'specular="0"'),
    "book_red": ("spine", "0.66 0.16 0.14", 'specular="0.05"'),
    "book_blue": ("spine", "0.16 0.30 0.55", 'specular="0.05"'),
    "book_green": ("spine", "0.18 0.42 0.28", 'specular="0.05"'),
    "book_sand": ("spine", "0.88 0.78 0.55", 'specular="0.05"'),
    "book_black": ("spine", "0.20 0.20 0.22", 'specular="0.05"'),
    "book_orange": ("spine", "0.90 0.50 0.18", 'specular="0.05"'),
    "garden": ("garden", "1 1 1", 'emission="0.55" specular="0"'),
    "landscape": ("landscape", "1 1 1", 'specular="0"'),
    "film": ("film", "1 1 1", 'emission="0.35" specular="0.2"'),
    "abstract": ("abstract", "1 1 1", 'specular="0"'),
    "portrait": ("portrait", "1 1 1", 'specular="0"'),
    "desktop": ("desktop", "1 1 1", 'emission="0.35" specular="0.2"'),
    "clock": ("clock", "1 1 1", 'specular="0"'),
    "paint": ("", "0.91 0.88 0.81", 'specular="0"'),
    "paint_sage": ("", "0.70 0.77 0.68", 'specular="0"'),
    "paint_sky": ("", "0.72 0.79 0.86", 'specular="0"'),
    "paint_clay": ("", "0.86 0.70 0.58", 'specular="0"'),
    "ceiling": ("", "0.95 0.95 0.93", 'emission="0.22" specular="0"'),
    "white": ("", "0.94 0.94 0.92", 'specular="0.2"'),
    "front": ("", "0.90 0.91 0.90", 'specular="0.25" shininess="0.5"'),
    "front_green": ("", "0.44 0.56 0.50", 'specular="0.2" shininess="0.5"'),
    "carcass": ("", "0.78 0.78 0.76", 'specular="0.1"'),
    "plinth": ("", "0.20 0.20 0.21", 'specular="0.1"'),
    "porcelain": ("", "0.96 0.96 0.95", 'specular="0.5" shininess="0.8"'),
    "steel": ("", "0.70 0.71 0.73", 'specular="0.6" shininess="0.7"'),
    "fridge": ("", "0.80 0.82 0.84", 'specular="0.4" shininess="0.6"'),
    "black": ("", "0.06 0.06 0.07", 'specular="0.5" shininess="0.7"'),
    "dark": ("", "0.18 0.18 0.19", 'specular="0.3" shininess="0.5"'),
    "screen": ("", "0.04 0.05 0.07", 'specular="0.7" shininess="0.9"'),
    "glow": ("", "0.98 0.92 0.76", 'emission="0.5" specular="0"'),
    "bulb": ("", "1 0.97 0.88", 'emission="0.8" specular="0"'),
    "terracotta": ("", "0.78 0.44 0.30", 'specular="0.05"'),
    "leaf": ("", "0.22 0.48 0.20", 'specular="0.15"'),
    "leaf_dark": ("", "0.16 0.38 0.22", 'specular="0.2"'),
    "tulip": ("", "0.88 0.26 0.34", 'specular="0.1"'),
    "cobalt": ("", "0.15 0.28 0.58", 'specular="0.5" shininess="0.8"'),
    "cherry": ("", "0.74 0.12 0.12", 'specular="0.5" shininess="0.8"'),
    "sun": ("", "0.95 0.76 0.22", 'specular="0.4" shininess="0.7"'),
    "mint": ("", "0.45 0.72 0.62", 'specular="0.4" shininess="0.7"'),
    "wine_glass": ("", "0.12 0.24 0.14", 'specular="0.7" shininess="0.9"'),
    "water_glass": ("", "0.42 0.66 0.78", 'specular="0.7" shininess="0.9"'),
    "label": ("", "0.93 0.90 0.80", 'specular="0"'),
    "orange": ("", "0.95 0.55 0.12", 'specular="0.2"'),
    "apple": ("", "0.58 0.74 0.18", 'specular="0.2"'),
    "wicker": ("", "0.74 0.60 0.40", 'specular="0"'),
    "cardboard": ("", "0.72 0.58 0.40", 'specular="0"'),
    "mirror": ("", "0.72 0.80 0.84", 'specular="0.9" shininess="1"'),
    "teal_shell": ("", "0.20 0.50 0.50", 'specular="0.2"'),
    "mustard_shell": ("", "0.88 0.66 0.22", 'specular="0.2"'),
}


def asset_lines(used):
    """The <asset> block of what bears a name in `used`; textures follow their materials."""
    materials = {name: look for name, look in _MATERIALS.items() if name in used}
    textures = {texture for texture, _, _ in materials.values()}
    lines = ["  <asset>"]
    lines += [
        f'    <texture name="{name}" type="{kind}" file="{name}.png"/>'
        for name, kind in _TEXTURES.items()
        if name in textures
    ] + [""]
    lines += [
        f'    <mesh name="{name}" file="{name}.obj" inertia="shell"/>'
        for name in _MESHES
        if name in used
    ]
    lines += [
        f'    <mesh name="{name}" file="{file}.obj" scale="{scale}" inertia="shell"/>'
        for name, (file, scale) in _SCALED.items()
        if name in used
    ] + [""]
    for name, (texture, rgb, more) in materials.items():
        picture = f' texture="{texture}"' if texture else ""
        lines.append(f'    <material name="{name}"{picture} rgba="{rgb} 1" {more}/>')
    return lines + ["  </asset>", ""]
