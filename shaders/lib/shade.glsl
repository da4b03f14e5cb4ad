// Lambert's law with the gradient as normal.
//
// `gradient`: world space, any length, pointing to larger values; surfaces face the other way. `to_light`: world space,
// unit. Returns the factor on the colour. Where the volume is flat there is no normal and only the ambient share is left,
// as in VTK.

real diffuse_factor(vec3 gradient, vec3 to_light, real ambient, real diffuse, bool two_sided) {
  real length2 = dot(gradient, gradient);
  real cosine = -dot(gradient, to_light) * inversesqrt(max(length2, real(1e-30)));
  cosine = two_sided ? abs(cosine) : max(cosine, real(0));
  return ambient + (length2 > real(1e-30) ? diffuse * cosine : real(0));
}
