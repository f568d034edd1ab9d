"""The shader programs, for compatibility profiles from OpenGL 2.1 on and for core profiles alike."""

from __future__ import annotations

from PySide6.QtGui import QOpenGLContext, QSurfaceFormat
from PySide6.QtOpenGL import QOpenGLShader, QOpenGLShaderProgram

from rvsim.errors import RvsimError
from rvsim.language import tr

_CORE = QSurfaceFormat.OpenGLContextProfile.CoreProfile
_OLD_WORDS = {"vertex": "#version 120\n", "fragment": "#version 120\n#define result gl_FragColor\n"}
_CORE_WORDS = {
    "vertex": "#version 140\n#define attribute in\n#define varying out\n",
    "fragment": "#version 140\n#define varying in\n#define texture2D texture\nout vec4 result;\n",
}

# A body is stretched here, before it is placed: `end` moves one half of a capsule away, so that its caps stay round.
BODY_VERTEX = """
uniform mat4 model_view;
uniform mat4 projection;
uniform vec3 scale;
uniform float stretch;
attribute vec3 position;
attribute vec3 normal;
attribute float end;
varying vec3 eye_normal;
varying vec3 own_normal;
varying vec3 own_place;
void main() {
    own_normal = normal;
    own_place = position;
    eye_normal = (model_view * vec4(normal, 0.0)).xyz;
    gl_Position = projection * (model_view * vec4(position * scale + vec3(0.0, 0.0, stretch * end), 1.0));
}
"""

# The light of the painter (painter_light.py): fixed to the viewer's upper left, matt with a soft highlight, and a sky.
BODY_FRAGMENT = """
uniform vec4 color;
uniform float lit;
uniform float edges;
varying vec3 eye_normal;
varying vec3 own_normal;
varying vec3 own_place;

// How far an edge of the unit box is, in pixels; the third direction, across the face, has none.
float to_edge() {
    vec3 pixels = (0.5 - abs(own_place)) / max(fwidth(own_place), 1e-9) + 1e3 * abs(own_normal);
    return min(min(pixels.x, pixels.y), pixels.z);
}

void main() {
    if (lit < 0.5) {
        result = color;
        return;
    }
    vec3 n = normalize(eye_normal);
    vec3 light = normalize(vec3(-0.42, 0.68, 0.60));
    vec3 halfway = normalize(light + vec3(0.0, 0.0, 1.0));
    float matt = 0.54 + 0.44 * max(dot(n, light), 0.0) + 0.09 * n.y;
    float shine = 0.26 * pow(max(dot(n, halfway), 0.0), 16.0);
    vec3 shaded = color.rgb * matt + shine * (1.0 - 0.5 * color.rgb);
    if (edges > 0.0) shaded *= 1.0 - edges * clamp(1.5 - to_edge(), 0.0, 1.0);
    result = vec4(shaded, color.a);
}
"""

# A piece of line is widened on the screen. Where it meets a neighbour both are cut at the bisector, so that nothing is
# painted twice; a free end is round. `lift` draws it a little before what lies at the same depth.
STROKE_VERTEX = """
uniform mat4 view;
uniform mat4 projection;
uniform vec2 viewport;
uniform float half_width;
uniform float lift;
attribute vec3 before;
attribute vec3 start;
attribute vec3 end;
attribute vec3 after;
attribute vec2 corner;
attribute float so_far;
varying vec2 place;
varying vec2 direction;
varying float reach;
varying float length_so_far;
varying float pixels_per_metre;

vec4 clipped(vec3 point) { return projection * (view * vec4(point, 1.0)); }

vec4 before_eye(vec4 point, vec4 other) {
    float a = point.z + point.w;
    float b = other.z + other.w;
    return (a < 0.0 && b > 0.0) ? mix(point, other, a / (a - b) * 1.0001) : point;
}

vec2 on_screen(vec4 point) { return 0.5 * viewport * point.xy / point.w; }

void main() {
    vec4 start_clip = clipped(start);
    vec4 end_clip = clipped(end);
    if (start_clip.z + start_clip.w <= 0.0 && end_clip.z + end_clip.w <= 0.0) {
        gl_Position = vec4(0.0, 0.0, 2.0, 1.0);
        return;
    }
    vec4 from = before_eye(start_clip, end_clip);
    vec4 to = before_eye(end_clip, start_clip);
    vec2 s = on_screen(from);
    vec2 e = on_screen(to);
    bool at_end = corner.x > 0.5;
    vec4 joint = at_end ? to : from;
    vec2 here = at_end ? e : s;
    vec2 neighbour = on_screen(before_eye(clipped(at_end ? after : before), joint));

    reach = distance(s, e);
    vec2 along = reach > 0.001 ? (e - s) / reach : vec2(1.0, 0.0);
    vec2 across = vec2(-along.y, along.x);
    vec2 next_step = at_end ? neighbour - e : s - neighbour;
    float next_length = length(next_step);
    vec2 next_along = next_length > 0.001 ? next_step / next_length : -along;
    float cosine = dot(along, next_along);
    float wide = half_width + 1.0;
    vec2 corner_at;
    if (cosine > -0.5 && wide * sqrt(max(1.0 - cosine * cosine, 0.0)) < (1.0 + cosine) * min(reach, next_length)) {
        vec2 bisector = across + vec2(-next_along.y, next_along.x);
        corner_at = here + bisector / (1.0 + cosine) * wide * corner.y;
    } else {
        corner_at = here + along * (2.0 * corner.x - 1.0) * wide + across * corner.y * wide;
    }
    direction = along;
    place = vec2(dot(corner_at - s, along), dot(corner_at - s, across));
    float metres = distance(start, end);
    pixels_per_metre = metres > 0.0 ? reach / metres : 1.0;
    length_so_far = so_far;

    vec4 lifted = joint + projection * vec4(0.0, 0.0, lift, 0.0);
    float depth = lifted.w > 0.0 ? max(lifted.z / lifted.w, -1.0) : -1.0;
    gl_Position = vec4(corner_at / (0.5 * viewport), depth, 1.0);
}
"""

# The edge is softened over one pixel by the distance to the line's axis: smooth without multisampling. Thick lines
# and dots look round by a dark rim (darkness, width) and a light spot (shift from the axis, radius, strength).
STROKE_FRAGMENT = """
uniform vec4 color;
uniform float half_width;
uniform float dash;
uniform vec2 rim;
uniform vec4 spot;
varying vec2 place;
varying vec2 direction;
varying float reach;
varying float length_so_far;
varying float pixels_per_metre;

float from_axis(vec2 point) { return length(vec2(point.x - clamp(point.x, 0.0, reach), point.y)); }

void main() {
    float off = from_axis(place);
    float cover = clamp(half_width + 0.5 - off, 0.0, 1.0);
    if (dash > 0.0) {
        float period = dash * pixels_per_metre;
        float p = mod(length_so_far * pixels_per_metre + place.x, period);
        cover *= clamp(0.5 + max(min(p, 0.615 * period - p), p - period), 0.0, 1.0);
    }
    if (cover * color.a < 0.004) discard;
    vec2 shift = vec2(dot(spot.xy, direction), dot(spot.xy, vec2(-direction.y, direction.x)));
    float spotted = spot.w * clamp(spot.z + 0.5 - from_axis(place - shift), 0.0, 1.0);
    float rimmed = rim.x * clamp(off - half_width + rim.y + 0.5, 0.0, 1.0);
    vec3 inside = mix(color.rgb, vec3(1.0), spotted);
    result = vec4(mix(inside, vec3(0.0), rimmed), color.a * cover);
}
"""


# A tent of nine taps along one direction: as two box blurs of five. Without a stride, the picture as it is.
BLUR_VERTEX = """
attribute vec2 corner;
varying vec2 place;
void main() {
    place = 0.5 * corner + 0.5;
    gl_Position = vec4(corner, 0.0, 1.0);
}
"""

BLUR_FRAGMENT = """
uniform sampler2D picture;
uniform vec2 stride;
uniform vec4 color;
varying vec2 place;
void main() {
    float sum = 0.0;
    if (stride.x + stride.y == 0.0) {
        sum = texture2D(picture, place).a;
    } else {
        for (int i = -4; i <= 4; i++) {
            sum += (5.0 - abs(float(i))) / 25.0 * texture2D(picture, place + float(i) * stride).a;
        }
    }
    if (sum < 0.002) discard;
    result = vec4(color.rgb, color.a * sum);
}
"""


class ShaderError(RvsimError):
    """The driver refuses a shader program."""

    def __init__(self, name: str, log: str) -> None:
        self.name, self.log = name, log
        super().__init__(
            tr(
                "the driver refuses the shader {name!r}: {reason}",
                name=name,
                reason=log.strip() or tr("it gives no reason"),
            )
        )


def body_program() -> QOpenGLShaderProgram:
    """For capsules and boxes; the context must be current."""
    return _program("body", BODY_VERTEX, BODY_FRAGMENT, "position")


def stroke_program() -> QOpenGLShaderProgram:
    """For lines and dots; the context must be current."""
    return _program("stroke", STROKE_VERTEX, STROKE_FRAGMENT, "start")


def blur_program() -> QOpenGLShaderProgram:
    """For the shadow; the context must be current."""
    return _program("blur", BLUR_VERTEX, BLUR_FRAGMENT, "corner")


def _program(name: str, vertex: str, fragment: str, first: str) -> QOpenGLShaderProgram:
    core = QOpenGLContext.currentContext().format().profile() == _CORE
    words = _CORE_WORDS if core else _OLD_WORDS
    program = QOpenGLShaderProgram()
    kind = QOpenGLShader.ShaderTypeBit
    compiled = program.addShaderFromSourceCode(
        kind.Vertex, words["vertex"] + vertex
    ) and program.addShaderFromSourceCode(kind.Fragment, words["fragment"] + fragment)
    # Some drivers draw nothing unless attribute 0 comes from an array.
    program.bindAttributeLocation(first, 0)
    if not (compiled and program.link()):
        raise ShaderError(name, program.log())
    return program
