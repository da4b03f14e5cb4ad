#include "gl/timer.h"

#include "core/errors.h"

namespace slicelens::gl {

TimerQuery::TimerQuery(const Functions& gl) : gl_(&gl) {
  GLuint name = 0;
  gl.GenQueries(1, &name);
  query_ = Query(gl, name);
  if (!query_)
    throw GraphicsError("the driver gives no timer query");
  GLint bits = 0;
  gl.GetQueryiv(GL_TIME_ELAPSED, GL_QUERY_COUNTER_BITS, &bits);
  counts_ = bits > 0;
}

void TimerQuery::begin() {
  begun_ = std::chrono::steady_clock::now();
  gl_->BeginQuery(GL_TIME_ELAPSED, query_.name());
}

void TimerQuery::end() { gl_->EndQuery(GL_TIME_ELAPSED); }

bool TimerQuery::available() const {
  GLint done = GL_FALSE;
  gl_->GetQueryObjectiv(query_.name(), GL_QUERY_RESULT_AVAILABLE, &done);
  return done != GL_FALSE;
}

std::optional<std::uint64_t> TimerQuery::result_nanoseconds() const {
  if (!counts_)
    return std::nullopt;
  GLuint64 nanoseconds = 0;
  gl_->GetQueryObjectui64v(query_.name(), GL_QUERY_RESULT, &nanoseconds);
  const auto passed =
      std::chrono::duration_cast<std::chrono::nanoseconds>(std::chrono::steady_clock::now() - begun_);
  if (nanoseconds > static_cast<std::uint64_t>(passed.count()))
    return std::nullopt;
  return nanoseconds;
}

void finish(const Functions& gl) { gl.Finish(); }

double elapsed_seconds(const Functions& gl, const std::function<void()>& work) {
  gl.Finish();
  const auto start = std::chrono::steady_clock::now();
  work();
  gl.Finish();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

std::uint64_t samples_passed(const Functions& gl, const std::function<void()>& work) {
  GLuint name = 0;
  gl.GenQueries(1, &name);
  const Query query(gl, name);
  gl.BeginQuery(GL_SAMPLES_PASSED, name);
  work();
  gl.EndQuery(GL_SAMPLES_PASSED);
  GLuint64 count = 0;
  gl.GetQueryObjectui64v(name, GL_QUERY_RESULT, &count);
  return count;
}

} // namespace slicelens::gl
