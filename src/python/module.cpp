// The extension module whirl_twin._native: what the package of Python computes with.
#include <pybind11/pybind11.h>
#include <yaml-cpp/yaml.h>

#include <exception>

#include "messages/input_error.h"
#include "python/conversions.h"
#include "python/listening.h"
#include "python/scene_object.h"
#include "scene/scene_error.h"
#ifdef WHIRL_TWIN_PLUGINS
#include "plugins/plugins.h"
#endif

namespace py = pybind11;

namespace whirl_twin {

namespace {

/// Raises the package's exception of this name.
void raise(const char* name, const std::string& what) {
  const py::object type = py::module_::import("whirl_twin.errors").attr(name);
  PyErr_SetObject(type.ptr(), pythonText(what).ptr());
}

void raiseScene(const SceneError& error) {
  py::list errors;
  for (const std::string& one : error.errors()) {
    errors.append(pythonText(one));
  }
  const py::object type = py::module_::import("whirl_twin.errors").attr("SceneError");
  PyErr_SetObject(type.ptr(), type(errors).ptr());
}

void translate(std::exception_ptr thrown) {
  try {
    if (thrown) {
      std::rethrow_exception(thrown);
    }
  } catch (const SceneError& error) {
    raiseScene(error);
  } catch (const InputError& error) {
    raise("InputError", error.what());
  } catch (const RunFailure& error) {
    raise("RunError", error.what());
  } catch (const YAML::Exception& error) {
    raise("InputError", error.what());
  }
}

}  // namespace

}  // namespace whirl_twin

PYBIND11_MODULE(_native, module) {
  using namespace whirl_twin;  // NOLINT(google-build-using-namespace): the body of a macro
  py::register_exception_translator(translate);
  takeMessages();
#ifdef WHIRL_TWIN_PLUGINS
  usePlugins();
#endif
  module.attr("version") = WHIRL_TWIN_VERSION;
  bindScene(module);
  bindSimulation(module);
  bindTwin(module);
  bindReports(module);
  bindStudies(module);
#ifdef WHIRL_TWIN_LCM
  bindLogs(module);
#endif
}
