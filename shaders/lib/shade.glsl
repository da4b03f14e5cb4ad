// Light on a sample.
//
// `gradient`: world space, any length, pointing to larger values; surfaces face the other way. `to_light`, `to_eye`:
// world space, unit. Where the volume is flat there is no normal. `color`: straight.

// Lambert's law. Returns the factor on the colour; only the ambient share is left where there is no normal, as in VTK.
real diffuse_factor(vec3 gradient, vec3 to_light, real ambient, real diffuse, bool two_sided) {
  real length2 = dot(gradient, gradient);
  real cosine = -dot(gradient, to_light) * inversesqrt(max(length2, real(1e-30)));
  cosine = two_sided ? abs(cosine) : max(cosine, real(0));
  return ambient + (length2 > real(1e-30) ? diffuse * cosine : real(0));
}

// The highlight of Phong (1975) as VTK's volume mappers have it: cosᵖ of the angle between the light's mirror image
// 2(n·l)n − l and the eye. Surfaces seen from behind have one as well where the light is two-sided.
real specular_share(vec3 gradient, vec3 to_light, vec3 to_eye, real specular, real power, bool two_sided) {
  real length2 = dot(gradient, gradient);
  vec3 normal = gradient * (-inversesqrt(max(length2, real(1e-30))));
  real cosine = dot(normal, to_light);
  vec3 mirrored = real(2) * cosine * normal - to_light;  // the same for both directions of the normal
  real lobe = max(dot(mirrored, to_eye), real(0));
  bool lit = length2 > real(1e-30) && (two_sided ? cosine != real(0) : cosine > real(0));
  return lit ? specular * pow(lobe, power) : real(0);
}

// Ambient and diffuse shares of the colour and a white highlight. No sample is brighter than white, or its associated
// colour would exceed its opacity.
vec3 phong_color(vec3 color, vec3 gradient, vec3 to_light, vec3 to_eye, real ambient, real diffuse, real specular,
                 real power, bool two_sided) {
  vec3 lit = color * diffuse_factor(gradient, to_light, ambient, diffuse, two_sided) +
             vec3(specular_share(gradient, to_light, to_eye, specular, power, two_sided));
  return min(lit, vec3(real(1)));
}

// Cool to warm (Gooch, Gooch, Shirley and Cohen 1998, eq. 2 with their α = 0.2 and β = 0.6): between cool + α·color where
// the surface faces away from the light and warm + β·color where it faces it, by k = (1 + n·l)/2. The whole range of
// angles has its tone, so there is no dark side and nothing that light on two sides could change. k = ½ without normal.
vec3 tone_color(vec3 color, vec3 gradient, vec3 to_light, vec3 cool, vec3 warm) {
  real length2 = dot(gradient, gradient);
  real cosine = -dot(gradient, to_light) * inversesqrt(max(length2, real(1e-30)));
  real k = real(0.5) + real(0.5) * (length2 > real(1e-30) ? cosine : real(0));
  return min(mix(cool + real(0.2) * color, warm + real(0.6) * color, k), vec3(real(1)));
}
