// Cohen's three 1D textures, one for each axis of the volume: R offset, G mask, B attenuation, A highlight (Cohen, Brodlie
// and Phillips 2008 §4, Fig. 5). AXIS_TABLES: pipeline `axis`; AXIS_WEIGHTS: masks are weights (connected lens).

#ifdef AXIS_TABLES
uniform sampler1D axis_table_x;
uniform sampler1D axis_table_y;
uniform sampler1D axis_table_z;

struct AxisTexels {
  vec4 x;
  vec4 y;
  vec4 z;
};

// The tables have no mip levels. Saying so spares a software rasteriser the choice of one: a tenth of the time.
vec4 axis_texel(sampler1D table, float x) { return textureLod(table, x, 0.0); }

// At the coordinate where a fragment is shown.
AxisTexels fetch_axis_tables(vec3 p) {
  return AxisTexels(axis_texel(axis_table_x, p.x), axis_texel(axis_table_y, p.y), axis_texel(axis_table_z, p.z));
}

#if defined(AXIS_UNMASKED)
float axis_mask(AxisTexels t) { return 1.0; }  // all masks of all tables are
#elif defined(AXIS_WEIGHTS)
float axis_mask(AxisTexels t) { return t.x.g * t.y.g * t.z.g; }
#else
// Masks are 0 or 1, and linear filtering crosses one half just where the nearest texel changes: the nearest mask without a
// fetch of its own.
float axis_mask(AxisTexels t) { return min(min(t.x.g, t.y.g), t.z.g) >= 0.5 ? 1.0 : 0.0; }
#endif

vec3 axis_offset(AxisTexels t) { return vec3(t.x.r, t.y.r, t.z.r); }

// Where the data shown at p is.
vec3 axis_texture_from_object(AxisTexels t, vec3 p) { return p + axis_mask(t) * axis_offset(t); }

// Attenuation and highlight: the products of the three axes' values.
vec2 axis_effects(AxisTexels t) { return t.x.ba * t.y.ba * t.z.ba; }

#if defined(GRADIENTS) || defined(FOOTPRINT)
// Derivatives of offset and mask by the coordinate, as differences over one texel.
vec2 axis_slope(sampler1D table, float x) {
  float count = float(textureSize(table, 0));
  float half_texel = 0.5 / count;
  return (axis_texel(table, x + half_texel).rg - axis_texel(table, x - half_texel).rg) * count;
}

// The Jacobian of the map that the tables hold, by texture coordinates.
mat3 axis_jacobian(vec3 p) {
  AxisTexels t = fetch_axis_tables(p);
  vec2 x = axis_slope(axis_table_x, p.x);
  vec2 y = axis_slope(axis_table_y, p.y);
  vec2 z = axis_slope(axis_table_z, p.z);
  vec3 diagonal = 1.0 + axis_mask(t) * vec3(x.r, y.r, z.r);
  mat3 result = mat3(diagonal.x, 0.0, 0.0, 0.0, diagonal.y, 0.0, 0.0, 0.0, diagonal.z);
#ifdef AXIS_WEIGHTS
  result += outerProduct(axis_offset(t), vec3(x.g * t.y.g * t.z.g, t.x.g * y.g * t.z.g, t.x.g * t.y.g * z.g));
#endif
  return result;
}

// The gradient of the displayed volume v∘u from that of the data: Jᵀ∇v, both by texture coordinates.
vec3 displayed_gradient(vec3 gradient, vec3 p) { return gradient * axis_jacobian(p); }
#endif
#endif
