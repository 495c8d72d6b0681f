#include "bihive/gl/program.h"

#include <algorithm>

#include "bihive/gl/shader_source.h"

namespace bihive {
namespace {

// "shader ...: first line of the log; second; ..."
Error refused(const std::string& name, const std::string& log) {
  std::string lines;
  for (const char c : log) {
    if (c == '\n' || c == '\0')
      lines += !lines.empty() && lines.back() != ' ' ? "; " : "";
    else
      lines += c;
  }
  while (!lines.empty() && (lines.back() == ' ' || lines.back() == ';')) lines.pop_back();
  return {"the graphics driver refuses the shader '" + name + "': " + lines, "", 0, 0, "choose an engine of the CPU"};
}

template <class Get>
std::string log_of(GLint length, const Get& get) {
  std::string log(static_cast<std::size_t>(std::max(length, 1)), '\0');
  GLsizei written = 0;
  get(static_cast<GLsizei>(log.size()), &written, log.data());
  log.resize(static_cast<std::size_t>(std::max(written, 0)));
  return log;
}

// 0 and an error, or a shader.
Result<GLuint> compile(const GlFunctions& gl, GLenum kind, const std::string& name,
                       const std::vector<std::string>& defines) {
  const Result<ShaderSource> source = assemble_shader(name, defines);
  if (!source) return source.error();
  const GLuint shader = gl.CreateShader(kind);
  const char* const text = source->text.c_str();
  gl.ShaderSource(shader, 1, &text, nullptr);
  gl.CompileShader(shader);
  GLint compiled = GL_FALSE;
  gl.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_TRUE) return shader;

  GLint length = 0;
  gl.GetShaderiv(shader, GL_INFO_LOG_LENGTH, &length);
  const std::string log = log_of(
      length, [&](GLsizei size, GLsizei* written, char* out) { gl.GetShaderInfoLog(shader, size, written, out); });
  gl.DeleteShader(shader);
  return refused(name, source->with_names(log));
}

}  // namespace

Result<GlProgram> GlProgram::link(const GlFunctions& gl, const std::string& name,
                                  const std::vector<std::string>& defines) {
  const Result<GLuint> vertex = compile(gl, GL_VERTEX_SHADER, "triangle", {});
  if (!vertex) return vertex.error();
  const Result<GLuint> fragment = compile(gl, GL_FRAGMENT_SHADER, name, defines);
  if (!fragment) {
    gl.DeleteShader(*vertex);
    return fragment.error();
  }

  const GLuint program = gl.CreateProgram();
  gl.AttachShader(program, *vertex);
  gl.AttachShader(program, *fragment);
  gl.LinkProgram(program);
  gl.DeleteShader(*vertex);
  gl.DeleteShader(*fragment);
  GLint linked = GL_FALSE;
  gl.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked == GL_TRUE) return GlProgram(gl, program);

  GLint length = 0;
  gl.GetProgramiv(program, GL_INFO_LOG_LENGTH, &length);
  const std::string log = log_of(
      length, [&](GLsizei size, GLsizei* written, char* out) { gl.GetProgramInfoLog(program, size, written, out); });
  gl.DeleteProgram(program);
  return refused(name, log);
}

void GlProgram::destroy() {
  gl_->DeleteProgram(program_);
}

GLint GlProgram::place(const char* uniform) {
  const auto known = places_.find(uniform);
  if (known != places_.end()) return known->second;
  const GLint found = gl_->GetUniformLocation(program_, uniform);
  places_.emplace(uniform, found);
  return found;
}

void GlProgram::set(const char* uniform, int value) {
  gl_->Uniform1i(place(uniform), value);
}
void GlProgram::set(const char* uniform, float value) {
  gl_->Uniform1f(place(uniform), value);
}
void GlProgram::set(const char* uniform, float x, float y) {
  gl_->Uniform2f(place(uniform), x, y);
}
void GlProgram::set(const char* uniform, Vec3f value) {
  gl_->Uniform3f(place(uniform), value.x, value.y, value.z);
}

}  // namespace bihive
