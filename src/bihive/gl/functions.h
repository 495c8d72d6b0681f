// The functions of OpenGL ES 3.00 that the library uses, found at run time. GL is not linked to the program, so the
// program also starts on machines without GL. Under WebAssembly they are the browser's functions.
#pragma once

#include <GLES3/gl3.h>

#include "bihive/base/result.h"

namespace bihive {

/// X(return type, name without "gl", parameters) for each.
#define BIHIVE_GL_FUNCTIONS(X)                                                                           \
  X(void, ActiveTexture, (GLenum))                                                                       \
  X(void, AttachShader, (GLuint, GLuint))                                                                \
  X(void, BindFramebuffer, (GLenum, GLuint))                                                             \
  X(void, BindTexture, (GLenum, GLuint))                                                                 \
  X(void, BindVertexArray, (GLuint))                                                                     \
  X(void, BlitFramebuffer, (GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLint, GLbitfield, GLenum)) \
  X(GLenum, CheckFramebufferStatus, (GLenum))                                                            \
  X(void, Clear, (GLbitfield))                                                                           \
  X(void, ClearBufferuiv, (GLenum, GLint, const GLuint*))                                                \
  X(void, ClearColor, (GLfloat, GLfloat, GLfloat, GLfloat))                                              \
  X(void, ColorMask, (GLboolean, GLboolean, GLboolean, GLboolean))                                       \
  X(void, CompileShader, (GLuint))                                                                       \
  X(GLuint, CreateProgram, (void))                                                                       \
  X(GLuint, CreateShader, (GLenum))                                                                      \
  X(void, DeleteFramebuffers, (GLsizei, const GLuint*))                                                  \
  X(void, DeleteProgram, (GLuint))                                                                       \
  X(void, DeleteShader, (GLuint))                                                                        \
  X(void, DeleteTextures, (GLsizei, const GLuint*))                                                      \
  X(void, DeleteVertexArrays, (GLsizei, const GLuint*))                                                  \
  X(void, Disable, (GLenum))                                                                             \
  X(void, DrawArrays, (GLenum, GLint, GLsizei))                                                          \
  X(void, Enable, (GLenum))                                                                              \
  X(void, FramebufferTexture2D, (GLenum, GLenum, GLenum, GLuint, GLint))                                 \
  X(void, GenFramebuffers, (GLsizei, GLuint*))                                                           \
  X(void, GenTextures, (GLsizei, GLuint*))                                                               \
  X(void, GenVertexArrays, (GLsizei, GLuint*))                                                           \
  X(GLenum, GetError, (void))                                                                            \
  X(void, GetIntegerv, (GLenum, GLint*))                                                                 \
  X(void, GetProgramInfoLog, (GLuint, GLsizei, GLsizei*, GLchar*))                                       \
  X(void, GetProgramiv, (GLuint, GLenum, GLint*))                                                        \
  X(void, GetShaderInfoLog, (GLuint, GLsizei, GLsizei*, GLchar*))                                        \
  X(void, GetShaderiv, (GLuint, GLenum, GLint*))                                                         \
  X(const GLubyte*, GetString, (GLenum))                                                                 \
  X(GLint, GetUniformLocation, (GLuint, const GLchar*))                                                  \
  X(void, LinkProgram, (GLuint))                                                                         \
  X(void, PixelStorei, (GLenum, GLint))                                                                  \
  X(void, ReadPixels, (GLint, GLint, GLsizei, GLsizei, GLenum, GLenum, void*))                           \
  X(void, Scissor, (GLint, GLint, GLsizei, GLsizei))                                                     \
  X(void, ShaderSource, (GLuint, GLsizei, const GLchar* const*, const GLint*))                           \
  X(void, TexImage2D, (GLenum, GLint, GLint, GLsizei, GLsizei, GLint, GLenum, GLenum, const void*))      \
  X(void, TexParameteri, (GLenum, GLenum, GLint))                                                        \
  X(void, Uniform1f, (GLint, GLfloat))                                                                   \
  X(void, Uniform1i, (GLint, GLint))                                                                     \
  X(void, Uniform2f, (GLint, GLfloat, GLfloat))                                                          \
  X(void, Uniform3f, (GLint, GLfloat, GLfloat, GLfloat))                                                 \
  X(void, UseProgram, (GLuint))                                                                          \
  X(void, Viewport, (GLint, GLint, GLsizei, GLsizei))

/// One context's functions. gl.GetError() is glGetError().
struct GlFunctions {
// NOLINTNEXTLINE(bugprone-macro-parentheses): they are parts of declarations
#define BIHIVE_GL_MEMBER(type, name, parameters) type(GL_APIENTRY* name) parameters = nullptr;
  BIHIVE_GL_FUNCTIONS(BIHIVE_GL_MEMBER)
#undef BIHIVE_GL_MEMBER
};

/// Looks every function up by its full name ("glGetError"), as eglGetProcAddress or glfwGetProcAddress does. Error: the
/// context lacks one.
using GlLoader = void (*(*)(const char* name))();
Result<GlFunctions> load_gl_functions(GlLoader loader);

#ifdef __EMSCRIPTEN__
/// The browser's.
GlFunctions browser_gl_functions();
#endif

}  // namespace bihive
