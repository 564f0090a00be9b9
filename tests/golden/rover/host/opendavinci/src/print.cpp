// Prints each Container of this design: the smallest application that takes them. Written by SenseDSL;
// do not edit: copy it to start an application of your own.
#include "messages.h"

#include <exception>
#include <iostream>

#include "opendavinci/odcore/base/module/DataTriggeredConferenceClientModule.h"
#include "opendavinci/odcore/data/Container.h"

namespace {

class Printer final : public odcore::base::module::DataTriggeredConferenceClientModule {
public:
    Printer(int argc, char **argv)
        : odcore::base::module::DataTriggeredConferenceClientModule(argc, argv, "rover_print") {}

private:
    void setUp() override {}
    void tearDown() override {}

    void nextContainer(odcore::data::Container &container) override {
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

    template <typename Message> static void print(odcore::data::Container &container) {
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
