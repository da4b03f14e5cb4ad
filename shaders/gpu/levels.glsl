// The volume in several textures: LEVELS bricks, one for each level of a pyramid (lib/levels.glsl), which the program
// binds for the tile that is drawn. With LEVELS 1 there is nothing to blend.

uniform sampler3D level_texture_0;
#if LEVELS > 1
uniform sampler3D level_texture_1;
#endif
#if LEVELS > 2
uniform sampler3D level_texture_2;
#endif
#if LEVELS > 3
uniform sampler3D level_texture_3;
#endif
#if LEVELS > 4
uniform sampler3D level_texture_4;
#endif
#if LEVELS > 5
uniform sampler3D level_texture_5;
#endif
#if LEVELS > 6
uniform sampler3D level_texture_6;
#endif
#if LEVELS > 7
uniform sampler3D level_texture_7;
#endif
uniform vec4 level_scale[LEVELS];   // the brick's texture coordinate = scale · volume's + offset
uniform vec4 level_offset[LEVELS];

#if LEVELS > 1
#include "gpu/level_choice.glsl"

// Of the levels at most two have weight. (Loops that run once or never would spare a software rasteriser the others, but
// Mesa's takes minutes to compile a gradient's seven samples of them.)
#define WEIGHT(k) max(1.0 - abs(sample_level - float(k)), 0.0)
#define LEVEL_TEXEL(k, name) filtered_texel(name, t * level_scale[k].xyz + level_offset[k].xyz)
#define ADD_LEVEL(k, name) if (WEIGHT(k) > 0.0) sum += WEIGHT(k) * LEVEL_TEXEL(k, name);

float sample_texel(vec3 t) {
  float sum = 0.0;
  ADD_LEVEL(0, level_texture_0)
  ADD_LEVEL(1, level_texture_1)
#if LEVELS > 2
  ADD_LEVEL(2, level_texture_2)
#endif
#if LEVELS > 3
  ADD_LEVEL(3, level_texture_3)
#endif
#if LEVELS > 4
  ADD_LEVEL(4, level_texture_4)
#endif
#if LEVELS > 5
  ADD_LEVEL(5, level_texture_5)
#endif
#if LEVELS > 6
  ADD_LEVEL(6, level_texture_6)
#endif
#if LEVELS > 7
  ADD_LEVEL(7, level_texture_7)
#endif
  return sum;
}
#else
float sample_texel(vec3 t) { return filtered_texel(level_texture_0, t * level_scale[0].xyz + level_offset[0].xyz); }
#endif
