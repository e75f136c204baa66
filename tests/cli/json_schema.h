// JSON Schema as docs/schemas uses it: type, enum, const, properties, required, items, anyOf,
// additionalProperties as a schema, minimum, maximum, $ref into $defs.
#pragma once

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

/// Holds a value against a schema, more strictly than the schema says: a key that `properties` does
/// not describe is a fault, and so is a word of the schema that this class does not know.
class JsonSchema {
  public:
    using Json = nlohmann::json;
    explicit JsonSchema(Json root) : root_(std::move(root)) {}

    /// What is wrong, a line each with its place; empty: nothing.
    std::vector<std::string> faults(const Json& value) const {
        std::vector<std::string> out;
        check(value, root_, "$", out);
        return out;
    }

  private:
    static bool is_of(const Json& value, const std::string& type) {
        if (type == "integer") return value.is_number_integer();
        if (type == "number") return value.is_number();
        if (type == "null") return value.is_null();
        return value.type_name() == type;
    }

    const Json& resolved(const Json& schema) const {
        if (!schema.contains("$ref")) return schema;
        return root_.at(Json::json_pointer(schema["$ref"].get<std::string>().substr(1)));
    }

    static void check_words(const Json& schema, const std::string& place,
                            std::vector<std::string>& out) {
        static const std::set<std::string> known{
            "$schema", "$id",     "$defs",   "$ref",      "title", "description",
            "type",    "enum",    "const",   "required",  "items", "additionalProperties",
            "anyOf",   "minimum", "maximum", "properties"};
        for (const auto& [word, ignored] : schema.items())
            if (!known.contains(word)) out.push_back(place + ": the schema says " + word);
    }

    void check(const Json& value, const Json& raw, const std::string& place,
               std::vector<std::string>& out) const {
        const Json& schema = resolved(raw);
        check_words(schema, place, out);
        if (schema.contains("anyOf")) return check_any(value, schema["anyOf"], place, out);
        check_type(value, schema, place, out);
        if (schema.contains("const") && value != schema["const"])
            out.push_back(place + ": not " + schema["const"].dump());
        if (schema.contains("enum") &&
            std::find(schema["enum"].begin(), schema["enum"].end(), value) == schema["enum"].end())
            out.push_back(place + ": " + value.dump() + " is none of " + schema["enum"].dump());
        if (value.is_number()) check_range(value, schema, place, out);
        if (value.is_object()) check_object(value, schema, place, out);
        if (value.is_array() && schema.contains("items"))
            for (std::size_t i = 0; i < value.size(); ++i)
                check(value[i], schema["items"], place + "[" + std::to_string(i) + "]", out);
    }

    void check_any(const Json& value, const Json& choices, const std::string& place,
                   std::vector<std::string>& out) const {
        std::vector<std::string> least;
        for (const Json& choice : choices) {
            std::vector<std::string> found;
            check(value, choice, place, found);
            if (found.empty()) return;
            if (least.empty() || found.size() < least.size()) least = found;
        }
        out.insert(out.end(), least.begin(), least.end());
    }

    static void check_type(const Json& value, const Json& schema, const std::string& place,
                           std::vector<std::string>& out) {
        if (!schema.contains("type")) return;
        const Json& type = schema["type"];
        const auto fits = [&](const Json& t) { return is_of(value, t.get<std::string>()); };
        if (type.is_string() ? !fits(type) : std::none_of(type.begin(), type.end(), fits))
            out.push_back(place + ": " + value.dump().substr(0, 60) + " is no " + type.dump());
    }

    static void check_range(const Json& value, const Json& schema, const std::string& place,
                            std::vector<std::string>& out) {
        if (value.get<double>() < schema.value("minimum", -1e300) ||
            value.get<double>() > schema.value("maximum", 1e300))
            out.push_back(place + ": " + value.dump() + " is out of range");
    }

    void check_object(const Json& value, const Json& schema, const std::string& place,
                      std::vector<std::string>& out) const {
        for (const Json& name : schema.value("required", Json::array()))
            if (!value.contains(name.get<std::string>()))
                out.push_back(place + ": no " + name.dump());
        const Json properties = schema.value("properties", Json::object());
        for (const auto& [key, inner] : value.items()) {
            const std::string at = place + "." + key;
            if (properties.contains(key))
                check(inner, properties[key], at, out);
            else if (schema.contains("additionalProperties"))
                check(inner, schema["additionalProperties"], at, out);
            else
                out.push_back(at + ": the schema does not describe it");
        }
    }

    Json root_;
};
