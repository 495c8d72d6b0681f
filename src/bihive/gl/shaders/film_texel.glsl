// A texel of the film (gl/film_textures.h): four numbers, or with FILM_OF_BITS their bits as integers.
#include "common"

#ifdef FILM_OF_BITS
#define FILM_SAMPLER usampler2D
#define FILM_TEXEL uvec4
vec4 film_numbers(uvec4 bits) {
  return uintBitsToFloat(bits);
}
uvec4 film_texel(vec4 numbers) {
  return floatBitsToUint(numbers);
}
#else
#define FILM_SAMPLER sampler2D
#define FILM_TEXEL vec4
vec4 film_numbers(vec4 numbers) {
  return numbers;
}
vec4 film_texel(vec4 numbers) {
  return numbers;
}
#endif
