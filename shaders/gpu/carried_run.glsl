// LOCAL_MODES in slices: what a ray has gathered so far lies in three textures, of which every fragment reads its own
// pixel before it writes it (render/carried_runs.h).

#ifdef LOCAL_MODES
uniform sampler2D carried_color;  // gathered, associated
uniform sampler2D carried_shown;  // as in lib/two_level.glsl
uniform sampler2D carried_run;    // row, mode, largest value, number of the slice that wrote it

TwoLevel carried_state(vec4 run) {
  ivec2 pixel = ivec2(gl_FragCoord.xy);
  TwoLevel state;
  state.gathered = texelFetch(carried_color, pixel, 0);
  state.row = int(floor(run.x + 0.5));
  state.mode = int(floor(run.y + 0.5));
  state.largest = run.z;
  state.shown = texelFetch(carried_shown, pixel, 0);
  return state;
}

vec4 carried_run_here() { return texelFetch(carried_run, ivec2(gl_FragCoord.xy), 0); }
#endif
