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
    Printer(int argc, char **argv) : core::base::ConferenceClientModule(argc, argv, "sense_print") {}

private:
    virtual void setUp() {}
    virtual void tearDown() {}

    virtual core::base::ModuleState::MODULE_EXITCODE body() {
        while (getModuleState() == core::base::ModuleState::RUNNING) {
        }
        return core::base::ModuleState::OKAY;
    }

    virtual void nextContainer(core::data::Container &container) {
        print< ::sense::IRFrontRight>(container);
        print< ::sense::IRRearRight>(container);
        print< ::sense::IRRear>(container);
        print< ::sense::USFront>(container);
        print< ::sense::USFrontRight>(container);
        print< ::sense::USRear>(container);
        print< ::sense::WheelLeftA>(container);
        print< ::sense::WheelLeftB>(container);
        print< ::sense::WheelRightA>(container);
        print< ::sense::WheelRightB>(container);
        print< ::sense::RCSteering>(container);
        print< ::sense::RCThrottle>(container);
        print< ::sense::RCSwitch>(container);
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
