#!/usr/bin/env perl
# An agent without Python: the easiest straight pot, or a safety. It reads one JSON line a message and answers a
# turn with one. Only what every perl has is used.
#
#   pooliad agent run 'stdio:perl examples/perl/straight.pl'
use strict;
use warnings;
use JSON::PP;

$| = 1;    # every answer leaves at once
my $json   = JSON::PP->new->canonical;
my $pi     = 4 * atan2(1, 1);
my $refusals = 0;
my $RADIUS   = 0.028575;    # of every ball, m

while (my $line = <STDIN>) {
    my $message = $json->decode($line);
    if ($message->{type} eq 'turn') {
        print $json->encode({ %{ choose($message->{view}) }, turn => $message->{turn} }), "\n";
    }
    elsif ($message->{type} eq 'refused') {
        $refusals++;
        print STDERR "refused: $message->{reason}\n";
    }
    elsif ($message->{type} eq 'game_started') {
        $refusals = 0;
    }
}

sub choose {
    my ($view) = @_;
    my $allowed = $view->{allowed};
    return { decision => $allowed->{decisions}[0] } if @{ $allowed->{decisions} };
    my %balls = %{ $view->{balls} };
    my $place = $view->{cue_ball_area} ? free_place($view, \%balls) : undef;
    $balls{0} = $place if $place;
    my ($shot, $call) = best_shot($view, \%balls);
    return {
        shot     => $shot,
        call     => $allowed->{call_required} ? $call : undef,
        cue_ball => $place,
    };
}

# The first of the options, the easiest pot first, for which the cue is free.
sub best_shot {
    my ($view, $balls) = @_;
    my $speed = $view->{phase} eq 'break' ? 9 : 3;
    for my $option (pots($view, $balls), safeties($view, $balls)) {
        my ($phi, $call) = @$option;
        my $theta = min_elevation($balls, $phi);
        next if !defined $theta || $theta > 60;
        return ({ v => 0 + $speed, phi => $phi, theta => $theta + 0.5, a => 0, b => 0 }, $call);
    }
    die "the cue is blocked in every direction\n";
}

# Asked of whoever runs this command, between the turn and its answer.
sub min_elevation {
    my ($balls, $phi) = @_;
    print $json->encode({ ask => 'min_elevation', balls => $balls, phi => $phi }), "\n";
    my $answer = $json->decode(scalar <STDIN>);
    die "$answer->{reason}\n" if $answer->{type} eq 'error';
    return $answer->{theta};
}

# Open pots [phi, call] in order of the cut: aim the cue ball at the place of the ghost ball.
sub pots {
    my ($view, $balls) = @_;
    my $radius = $RADIUS;
    my @found;
    for my $ball (@{ $view->{callable_balls} }) {
        my @mouths = mouths($view->{table});
        for my $pocket (0 .. 5) {
            my ($to_pocket, $far) = polar($balls->{$ball}, $mouths[$pocket]);
            my $ghost = [
                $balls->{$ball}[0] - 2 * $radius * cos($to_pocket),
                $balls->{$ball}[1] - 2 * $radius * sin($to_pocket),
            ];
            my ($aim, $near) = polar($balls->{0}, $ghost);
            my $cut = abs(atan2(sin($to_pocket - $aim), cos($to_pocket - $aim)));
            next if $cut > 1.2 || !is_clear($balls, $balls->{0}, $ghost, $radius, 0, $ball);
            next if !is_clear($balls, $balls->{$ball}, $mouths[$pocket], $radius, 0, $ball);
            push @found, [ $cut * ($near + $far), degrees($aim), { ball => 0 + $ball, pocket => 0 + $pocket } ];
        }
    }
    return map { [ @$_[ 1, 2 ] ] } sort { $a->[0] <=> $b->[0] } @found;
}

# At the first ball that may be struck, then all round, turned a little after every refusal.
sub safeties {
    my ($view, $balls) = @_;
    my $table  = $view->{table};
    my ($ball) = @{ $view->{callable_balls} };
    my $target = defined $ball ? $balls->{$ball} : [ $table->{width} / 2, $table->{length} / 4 ];
    my ($phi)  = polar($balls->{0}, $target);
    return map { [ degrees($phi) + $refusals + $_, 'safety' ] } 0 .. 359;
}

sub free_place {
    my ($view, $balls) = @_;
    my $area   = $view->{cue_ball_area};
    my $apart  = 2 * $RADIUS + 1e-6;
    my ($x0, $x1, $y0, $y1) = (@{ $area->{x} }, @{ $area->{y} });
    for my $step (5 .. 95) {    # clear of the cushions, where the cue would have to be raised
        for my $column (5, 3, 7, 4, 6) {
            my $place = [ $x0 + $column / 10 * ($x1 - $x0), $y0 + $step / 100 * ($y1 - $y0) ];
            my @near = grep { $_ ne '0' && (polar($balls->{$_}, $place))[1] <= $apart } keys %$balls;
            return $place if !@near;
        }
    }
    die "no place for the cue ball\n";
}

# The middle of each mouth, about where a ball's centre enters: corners, and the middle of the long sides.
sub mouths {
    my ($table) = @_;
    my ($w, $l, $r) = (@$table{qw(width length)}, $RADIUS);
    return ([ $r, $r ], [ 0, $l / 2 ], [ $r, $l - $r ], [ $w - $r, $l - $r ], [ $w, $l / 2 ], [ $w - $r, $r ]);
}

sub polar {
    my ($from, $to) = @_;
    my ($x, $y) = ($to->[0] - $from->[0], $to->[1] - $from->[1]);
    return (atan2($y, $x), sqrt($x * $x + $y * $y));
}

sub degrees { return 180 / $pi * shift }

# Whether a ball may roll from one place to another without meeting any but those named.
sub is_clear {
    my ($balls, $from, $to, $radius, @ignored) = @_;
    my ($phi, $length) = polar($from, $to);
    for my $ball (keys %$balls) {
        next if grep { $_ == $ball } @ignored;
        my ($x, $y) = ($balls->{$ball}[0] - $from->[0], $balls->{$ball}[1] - $from->[1]);
        my $along = $x * cos($phi) + $y * sin($phi);
        $along = 0 if $along < 0;
        $along = $length if $along > $length;
        my ($dx, $dy) = ($x - $along * cos($phi), $y - $along * sin($phi));
        return 0 if $dx * $dx + $dy * $dy < 4 * $radius * $radius;
    }
    return 1;
}
