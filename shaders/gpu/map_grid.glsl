// What warp/grid.glsl asks of its host: displacements in a 3D texture of floats, one texel for each node.
// FILTER_LINEAR_EXACT: weighed in float here; else by the driver, which may weigh with 8 bits (llvmpipe: float).

#define GridRef sampler3D

vec3 grid_node(GridRef grid, ivec3 i) { return texelFetch(grid, i, 0).xyz; }

vec3 sample_grid(GridRef grid, vec3 x, vec3 texel) {
#ifdef FILTER_LINEAR_EXACT
  ivec3 last = textureSize(grid, 0) - 1;
  ivec3 i = min(ivec3(x), last - 1);
  vec3 f = x - vec3(i);
  vec3 low = mix(mix(grid_node(grid, i), grid_node(grid, i + ivec3(1, 0, 0)), f.x),
                 mix(grid_node(grid, i + ivec3(0, 1, 0)), grid_node(grid, i + ivec3(1, 1, 0)), f.x), f.y);
  vec3 high = mix(mix(grid_node(grid, i + ivec3(0, 0, 1)), grid_node(grid, i + ivec3(1, 0, 1)), f.x),
                  mix(grid_node(grid, i + ivec3(0, 1, 1)), grid_node(grid, i + ivec3(1, 1, 1)), f.x), f.y);
  return mix(low, high, f.z);
#else
  // Nodes are texel centres. There are no mip levels; saying so spares a software rasteriser the choice of one.
  return textureLod(grid, (x + 0.5) * texel, 0.0).xyz;
#endif
}
