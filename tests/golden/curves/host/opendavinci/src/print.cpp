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
        : odcore::base::module::DataTriggeredConferenceClientModule(argc, argv, "curves_print") {}

private:
    void setUp() override {}
    void tearDown() override {}

    void nextContainer(odcore::data::Container &container) override {
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
