#include "options.h"

#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/vector.h>

#include <tuple>

#include "bindings.h"

namespace mspskel::python {
namespace {

namespace nb = nanobind;

class Table {
 public:
  Table(const std::vector<std::string>& words, Options& target) : line_("", ""), table_(words, target.run) {
    table_.add_general(line_);
    line_.flag("--keep-failed", target.keep_failed,
               "return the skeleton even if it fails its checks, which its `failure` says");
    cli::add_repair_options(line_, target.run.repair);
    table_.add_stages(line_);
  }
  void parse(const std::vector<std::string>& words) {
    line_.parse(words);
    table_.resolve(line_);
  }
  const cli::CommandLine& line() const { return line_; }

 private:
  cli::CommandLine line_;
  cli::RunOptionTable table_;
};

using Row = std::tuple<std::string, std::string, std::string, std::string, std::string>;

std::vector<Row> option_table(const std::string& mode) {
  Options options;
  const Table table({"--mode=" + mode}, options);
  std::vector<Row> rows;
  for (const cli::OptionEntry& entry : table.line().entries())
    rows.emplace_back(entry.name, entry.group, entry.value, entry.initial, entry.help);
  return rows;
}

}  // namespace

Options parse_options(const std::vector<std::string>& words) {
  Options options;
  Table table(words, options);
  table.parse(words);
  options.values = table.line().values();
  return options;
}

void bind_options(nb::module_& module) {
  nb::class_<Options>(module, "Options", "What is computed; see mspskel.Options.")
      .def(
          "__init__",
          [](Options* self, const std::vector<std::string>& words) {
            new (self) Options(parse_options(words));
          },
          nb::arg("words"))
      .def_prop_ro("keep_failed", [](const Options& self) { return self.keep_failed; })
      .def_prop_ro("time_limit", [](const Options& self) { return self.run.time_limit; })
      .def("json", [](const Options& self) { return self.values.dump(); });
  module.def("option_table", &option_table, nb::arg("mode") = "default",
             "Rows of name, group, kind of value, default and help.");
}

}  // namespace mspskel::python
