// A linked program of OpenGL, and its uniforms by name.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "bihive/base/result.h"
#include "bihive/gl/functions.h"
#include "bihive/math/vec3.h"

namespace bihive {

/// The functions' context must be current in every call. The destructor deletes nothing, because a lost context takes
/// its programs with it.
class GlProgram {
 public:
  /// Links the chunk `name` as fragment shader, on a triangle that covers the target. Error: the compiler's messages
  /// with chunk and line.
  static Result<GlProgram> link(const GlFunctions& gl, const std::string& name,
                                const std::vector<std::string>& defines);
  void destroy();

  void use() const { gl_->UseProgram(program_); }
  // Sets a uniform of the program in use. Does nothing if the program has no such uniform.
  void set(const char* uniform, int value);
  void set(const char* uniform, bool value) { set(uniform, value ? 1 : 0); }
  void set(const char* uniform, float value);
  void set(const char* uniform, float x, float y);
  void set(const char* uniform, Vec3f value);

 private:
  GlProgram(const GlFunctions& gl, GLuint program) : gl_(&gl), program_(program) {}
  GLint place(const char* uniform);

  const GlFunctions* gl_;
  GLuint program_;
  std::map<std::string, GLint, std::less<>> places_;
};

}  // namespace bihive
