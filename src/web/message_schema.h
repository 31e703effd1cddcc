// JSON Schema of the messages as messageJson() (reports/live_lines.h) writes them.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

#include "messages/fields.h"
#include "reports/output.h"

namespace whirl_twin {

/// Type of a value in JSON; what is not finite is null.
template <class Value>
Json valueSchema(const Value*) {
  if constexpr (std::is_same_v<Value, bool>) {
    return {{"type", "boolean"}};
  } else if constexpr (std::is_floating_point_v<Value>) {
    return {{"type", "number"}};
  } else if constexpr (std::is_same_v<Value, std::string>) {
    return {{"type", "string"}};
  } else {
    return {{"type", "integer"}};
  }
}
template <class Value>
Json valueSchema(const std::vector<Value>*) {
  return {{"type", "array"}, {"items", valueSchema(static_cast<const Value*>(nullptr))}};
}

template <class State>
class SchemaVisit : public FieldVisit<SchemaVisit<State>> {
 public:
  explicit SchemaVisit(Json& schema) : schema_(schema) {
    schema_ = {{"type", "object"}, {"properties", Json::object()}};
  }

  void head() { instant("step"); }
  template <class F>
  void head(F field) {
    head();
    add(field.name, {{"type", "string"}});
  }
  template <class F>
  void sampled(F field) {
    instant("sample");
    add(field.name, {{"type", "string"}});
  }
  void stamped() { add("stamp", {{"type", "integer"}, {"description", "ns"}}); }
  template <class F, class Check>
  void value(F field, const char* unit, Check, Stays) {
    Json schema = valueSchema(static_cast<const TypeOf<F>*>(nullptr));
    if (*unit != '\0') {
      schema["description"] = unit;
    }
    add(field.name, std::move(schema));
  }
  template <class F>
  void negated(F field) {
    add(field.name, {{"type", "boolean"}});
  }
  template <class L, class F>
  void rows(L, F field) {
    using Row = typename TypeOf<F>::value_type;
    Json row;
    SchemaVisit<Row> visit(row);
    Row::fields(visit);
    add(field.name, {{"type", "array"}, {"items", row}});
  }

 private:
  template <class F>
  using TypeOf = std::decay_t<decltype(std::declval<F>().of(std::declval<State&>()))>;

  void instant(const char* count) {
    add(count, {{"type", "integer"}});
    add("time", {{"type", "number"}, {"description", "s, simulated"}});
    stamped();
  }
  void add(const char* name, Json schema) { schema_["properties"][name] = std::move(schema); }

  Json& schema_;
};

template <class State>
Json messageSchema() {
  Json schema;
  SchemaVisit<State> visit(schema);
  State::fields(visit);
  return schema;
}

}  // namespace whirl_twin
