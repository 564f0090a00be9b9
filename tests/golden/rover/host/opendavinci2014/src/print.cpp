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
    Printer(int argc, char **argv) : core::base::ConferenceClientModule(argc, argv, "rover_print") {}

private:
    virtual void setUp() {}
    virtual void tearDown() {}

    virtual core::base::ModuleState::MODULE_EXITCODE body() {
        while (getModuleState() == core::base::ModuleState::RUNNING) {
        }
        return core::base::ModuleState::OKAY;
    }

    virtual void nextContainer(core::data::Container &container) {
        print< ::sense::rover::Ranger>(container);
        print< ::sense::rover::Line>(container);
        print< ::sense::rover::Bumper>(container);
        print< ::sense::rover::Wheels>(container);
        print< ::sense::rover::Bent>(container);
        print< ::sense::rover::Acceleration>(container);
        print< ::sense::rover::Rate>(container);
        print< ::sense::rover::Position>(container);
        print< ::sense::rover::Escs>(container);
        print< ::sense::rover::Lamps>(container);
        print< ::sense::rover::Winch>(container);
        print< ::sense::rover::Speed>(container);
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
