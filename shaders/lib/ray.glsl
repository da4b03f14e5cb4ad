// Rays through pixels and where their samples lie (docs/spaces.md).
//
// A ray's origin is its anchor, the point from which sample distances count: on the plane through the box centre in
// orthographic views, at the eye's distance from the box centre under perspective. Sample k lies at
// origin + (k + ½)Δ·direction, so that orthographic rays meet the very points of the slice stack.

// What a picture's rays share, in texture space; vectors are per world unit of length.
struct RayFrame {
  vec3 center;      // the anchor of the ray through the picture's middle
  vec3 forward;     // unit vector along the view axis
  vec3 right;       // to the picture's right edge: half its width (orthographic, world units) or tangent (perspective)
  vec3 up;          // to its top edge, likewise
  real half_width;  // perspective only: the tangents themselves
  real half_height;
  real anchor;      // perspective only: |eye − box centre|, world units
};

struct PixelRay {
  vec3 origin;     // the anchor, texture space
  vec3 direction;  // texture units per world unit
  real start;      // distance of the eye from the anchor, ≤ 0: nothing is sampled before it
};

// (x, y) in [−1, 1]², y up: the pixel's place in the picture.
PixelRay ray_from_pixel(RayFrame frame, bool perspective, real x, real y) {
  PixelRay ray;
  if (perspective) {
    real u = x * frame.half_width;
    real v = y * frame.half_height;
    // direction = forward + bend; the anchor is not counted from the eye, which under narrow view angles is so far
    // off that floats would lose the box (at 2° eye + distance·direction costs 20 dB).
    real slope2 = u * u + v * v;
    real secant = sqrt(real(1) + slope2);
    vec3 bend = (x * frame.right + y * frame.up - frame.forward * (slope2 / (real(1) + secant))) / secant;
    ray.direction = frame.forward + bend;
    ray.origin = frame.center + frame.anchor * bend;
    ray.start = -frame.anchor;
  } else {
    ray.direction = frame.forward;
    ray.origin = frame.center + x * frame.right + y * frame.up;
    ray.start = real(-1e30);
  }
  return ray;
}

// Distances (near, far) from the origin between which the ray is in the box [low, high]; near > far when it misses.
vec2 hit_box(PixelRay ray, vec3 box_low, vec3 box_high) {
  // A component of exactly 0 would divide by zero; 1e-20 puts the hits of that axis out of everybody's way.
  vec3 d = vec3(abs(ray.direction.x) < real(1e-20) ? real(1e-20) : ray.direction.x,
                abs(ray.direction.y) < real(1e-20) ? real(1e-20) : ray.direction.y,
                abs(ray.direction.z) < real(1e-20) ? real(1e-20) : ray.direction.z);
  vec3 a = (box_low - ray.origin) / d;
  vec3 b = (box_high - ray.origin) / d;
  vec3 low = min(a, b);
  vec3 high = max(a, b);
  return vec2(max(max(max(low.x, low.y), low.z), ray.start), min(min(high.x, high.y), high.z));
}

// The part of `interval` on the kept side of a plane: dot(plane.xyz, t) + plane.w ≥ 0.
vec2 clip_interval(vec2 interval, PixelRay ray, vec4 plane) {
  vec3 normal = vec3(plane.x, plane.y, plane.z);
  real value = dot(normal, ray.origin) + plane.w;
  real slope = dot(normal, ray.direction);
  if (abs(slope) < real(1e-20)) {
    return value >= real(0) ? interval : vec2(real(1), real(0));
  }
  real crossing = -value / slope;
  return slope > real(0) ? vec2(max(interval.x, crossing), interval.y) : vec2(interval.x, min(interval.y, crossing));
}

// Index of the first sample at or after `near`, and of the last at or before `far`, for sample distance `delta`.
real first_sample(real near, real delta) { return ceil(near / delta - real(0.5)); }
real last_sample(real far, real delta) { return floor(far / delta - real(0.5)); }
