// A random offset for each pixel (render.jitter), the same in every pipeline: x from the left and y from the bottom of the
// picture. Integers are mixed by shifts and odd multipliers (a finaliser of 32 bits, as in Wellons 2018), so there is no
// state to keep and neighbours have nothing in common. In [−1/2, 1/2).

real pixel_offset(uint x, uint y, uint seed) {
  uint h = (x * 0x9E3779B1u) ^ (y * 0x85EBCA77u + seed * 0xC2B2AE3Du);
  h = (h ^ (h >> 16u)) * 0x7FEB352Du;
  h = (h ^ (h >> 15u)) * 0x846CA68Bu;
  h = h ^ (h >> 16u);
  return real(h >> 8u) / real(16777216) - real(0.5);
}
