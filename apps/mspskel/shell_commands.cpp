// mspskel completion SHELL, mspskel man: what shells and man want to know of the program.
#include <iostream>

#include "commands.h"
#include "completion.h"
#include "man_page.h"
#include "mspskel/base/error.h"

namespace mspskel::cli {
namespace {

class CompletionCommand : public Command {
 public:
  CompletionCommand()
      : Command("completion bash|zsh|fish",
                "Prints a script that completes mspskel's commands, options and values in a shell.") {
    line().argument("SHELL", shell_, "bash, zsh or fish", shells())->required();
    line().section({"Where it goes",
                    "  bash   source <(mspskel completion bash)\n"
                    "  zsh    mspskel completion zsh > a folder of $fpath/_mspskel\n"
                    "  fish   mspskel completion fish > ~/.config/fish/completions/mspskel.fish\n"});
  }

  int run() override {
    const std::string wrong = check_word(shell_, shells());
    if (!wrong.empty()) throw UsageError(wrong);
    std::cout << (shell_ == "bash"  ? bash_completion()
                  : shell_ == "zsh" ? zsh_completion()
                                    : fish_completion());
    return 0;
  }

 private:
  static std::vector<std::string> shells() { return {"bash", "zsh", "fish"}; }

  std::string shell_;
};

class ManCommand : public Command {
 public:
  ManCommand() : Command("man", "Prints the manual page: mspskel man | man -l -") {}

  int run() override {
    std::cout << man_page();
    return 0;
  }
};

}  // namespace

std::unique_ptr<Command> make_completion_command(const std::vector<std::string>&) {
  return std::make_unique<CompletionCommand>();
}

std::unique_ptr<Command> make_man_command(const std::vector<std::string>&) {
  return std::make_unique<ManCommand>();
}

}  // namespace mspskel::cli
