// Prints each Container of this design: the smallest application that takes them. Written by SenseDSL;
// do not edit: copy it to start an application of your own.
#include "messages.h"

#include <exception>
#include <iostream>

#include "core/base/ConferenceClientModule.h"
#include "core/base/ModuleState.h"

namespace {

class Printer : public core::base::ConferenceClientModule {
public:
    Printer(int argc, char **argv) : core::base::ConferenceClientModule(argc, argv, "curves_print") {}

private:
    virtual void setUp() {}
    virtual void tearDown() {}

    virtual core::base::ModuleState::MODULE_EXITCODE body() {
        while (getModuleState() == core::base::ModuleState::RUNNING) {
        }
        return core::base::ModuleState::OKAY;
    }

    virtual void nextContainer(core::data::Container &container) {
        print< ::sense::curves::Ranger>(container);
        print< ::sense::curves::Line>(container);
        print< ::sense::curves::Bumper>(container);
        print< ::sense::curves::Wheels>(container);
        print< ::sense::curves::Bent>(container);
        print< ::sense::curves::Acceleration>(container);
        print< ::sense::curves::Rate>(container);
        print< ::sense::curves::Position>(container);
        print< ::sense::curves::Escs>(container);
        print< ::sense::curves::Lamps>(container);
        print< ::sense::curves::Winch>(container);
        print< ::sense::curves::Speed>(container);
    }

    template <typename Message> static void print(core::data::Container &container) {
        if (container.getDataType() == Message::ID()) {
            std::cout << container.getData<Message>().toString() << std::endl;
        }
    }
};

} // namespace

int main(int argc, char **argv) {
    try {
        Printer printer(argc, argv);
        return printer.runModule();
    } catch (const std::exception &problem) {
        std::cerr << problem.what() << "\nusage: " << argv[0] << " --cid=2..253 --freq=HZ" << std::endl;
        return 2;
    }
}
